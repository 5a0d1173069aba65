// SPDX-License-Identifier: MIT
// search.js - finds sections of the site by their words; the list of sections (sections.js, made by build.sh) is
// loaded when one begins to type, by a script, for a page from disk may fetch nothing.

// The sections that have every word, best first: in the heading counts more than in the text, a whole word more
// than a part.
function findSections(sections, query) {
    const words = query.toLowerCase().split(/\s+/).filter((word) => word);
    const escaped = words.map((word) => word.replace(/[\\^$.*+?()[\]{}|/]/g, '\\$&'));
    const whole = escaped.map((word) => new RegExp(`(^|[^\\p{L}\\p{N}_])${word}($|[^\\p{L}\\p{N}_])`, 'iu'));
    const rate = ([, , heading, text]) => words.reduce((sum, word, i) => {
        const head = heading.toLowerCase().includes(word), body = text.toLowerCase().includes(word);
        const rating = 8 * head + 4 * whole[i].test(heading) + body + 2 * whole[i].test(text);
        return rating ? sum + rating : -Infinity;
    }, 0);
    return words.length === 0 ? [] : sections.map((section) => [rate(section), section]).filter(([rating]) => rating > 0)
        .sort(([a], [b]) => b - a).map(([, section]) => section);
}

// The text around the first of the words that it has.
function excerpt(text, query) {
    const line = text.replace(/\s+/g, ' '), lower = line.toLowerCase();
    const at = Math.max(0, Math.min(...query.toLowerCase().split(/\s+/).map((word) => lower.indexOf(word)).filter((i) => i >= 0)));
    const from = Number.isFinite(at) ? Math.max(0, at - 40) : 0;
    return `${from > 0 ? '…' : ''}${line.slice(from, from + 140)}${line.length > from + 140 ? '…' : ''}`;
}

function listen(input, list) {
    const { root } = input.dataset;
    function show() {
        const found = findSections(globalThis.sections ?? [], input.value).slice(0, 12);
        list.hidden = input.value.trim() === '';
        list.replaceChildren(...found.map(([page, anchor, heading, text]) => {
            const item = document.createElement('li'), link = document.createElement('a');
            const head = document.createElement('b'), rest = document.createElement('small');
            link.href = `${root}${page}${anchor ? `#${anchor}` : ''}`;
            head.textContent = heading;
            rest.textContent = `${page}: ${excerpt(text, input.value)}`;
            link.append(head, rest);
            item.append(link);
            return item;
        }));
        if (found.length === 0)
            list.textContent = globalThis.sections ? 'Nothing has all these words.' : 'Loading …';
    }
    function load() {
        const script = document.createElement('script');
        script.src = `${root}docs/site/sections.js`;
        script.onload = show;
        document.head.append(script);
    }
    input.addEventListener('focus', load, { once: true });
    input.addEventListener('input', show);
    document.addEventListener('click', ({ target }) => { list.hidden ||= !target.closest('search'); });
    document.addEventListener('keydown', ({ key }) => { list.hidden ||= key === 'Escape'; });
}

if (globalThis.document)
    listen(document.getElementById('search'), document.getElementById('found'));
else
    globalThis.findSections = findSections;
