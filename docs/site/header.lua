-- SPDX-License-Identifier: MIT
-- Pandoc reader of a public header (or of a shader): its comments as text, its declarations as
-- code whose names are anchors and links. A function without a comment is an error.
local folder = PANDOC_SCRIPT_FILE:match('^(.*/)')
local api = dofile(folder .. 'api.lua')
local index = api.index()
local anchored = {} -- the names that have their anchor on this page

local function escape(text)
    return (text:gsub('[&<>]', { ['&'] = '&amp;', ['<'] = '&lt;', ['>'] = '&gt;' }))
end

-- Code as HTML: names in `own` are anchors where they first stand, others link to theirs.
local function code_html(code, own)
    local defined = {}
    for _, name in ipairs(own) do
        defined[name] = true
    end
    local function mark(text)
        return (escape(text):gsub('[%a_][%w_]*', function(name)
            if defined[name] and not anchored[name] then
                anchored[name] = true
                return '<b id="' .. name .. '">' .. name .. '</b>'
            end
            local link = not defined[name] and api.link(index, name)
            return link and '<a href="' .. link .. '">' .. name .. '</a>'
        end))
    end
    local html, at = {}, 1
    while true do
        local first, last = code:find('/%*.-%*/', at)
        html[#html + 1] = mark(code:sub(at, (first or 0) - 1))
        if not first then
            break
        end
        html[#html + 1] = '<span class="co">' .. escape(code:sub(first, last)) .. '</span>'
        at = last + 1
    end
    return '<pre class="declaration"><code>' .. table.concat(html) .. '</code></pre>'
end

-- Text with the library's names as links.
local function inlines(text)
    local list = {}
    for blank, word in text:gmatch('(%s*)(%S+)') do
        if blank ~= '' then
            list[#list + 1] = pandoc.Space()
        end
        local before, name, after = word:match('^(%p*)([lL][mM][pP]_[%w_]+)(.*)$')
        local target = name and api.link(index, name)
        if target then
            list[#list + 1] = pandoc.Str(before)
            list[#list + 1] = pandoc.Link({ pandoc.Code(name) }, target)
            list[#list + 1] = pandoc.Str(after)
        else
            local left, code, right = word:match('^(%p-)`([^`]+)`(.*)$')
            list[#list + 1] = pandoc.Str(left or word)
            if code then
                list[#list + 1] = pandoc.Code(code)
                list[#list + 1] = pandoc.Str(right)
            end
        end
    end
    return list
end

-- Lines of prose as one paragraph; a line that ends early was ended on purpose.
local function paragraph(lines)
    local list = {}
    for i, line in ipairs(lines) do
        local width = utf8.len(line) + 4
        for _, inline in ipairs(inlines(line)) do
            list[#list + 1] = inline
        end
        local next_word = lines[i + 1] and lines[i + 1]:match('^%S+')
        if next_word then
            local broken = width + utf8.len(next_word) <= 97
            list[#list + 1] = broken and pandoc.LineBreak() or pandoc.Space()
        end
    end
    return pandoc.Para(list)
end

-- A comment as blocks: prose, lists of "  - ", and whatever else is indented as it stands.
local function comment_blocks(comment)
    local blocks, kind, lines = {}, nil, {}
    local function flush()
        if kind == 'prose' then
            blocks[#blocks + 1] = paragraph(lines)
        elseif kind == 'list' then
            local entries, current = {}, nil
            for _, line in ipairs(lines) do
                local start = line:match('^  %- (.*)')
                if start then
                    current = { start }
                    entries[#entries + 1] = current
                else
                    current[#current + 1] = line:match('^%s*(.*)')
                end
            end
            local list = {}
            for _, entry in ipairs(entries) do
                list[#list + 1] = { pandoc.Plain(inlines(table.concat(entry, ' '))) }
            end
            blocks[#blocks + 1] = pandoc.BulletList(list)
        elseif kind == 'indented' then
            blocks[#blocks + 1] = pandoc.RawBlock('html', '<pre class="note">' ..
                escape(table.concat(lines, '\n')) .. '</pre>')
        end
        kind, lines = nil, {}
    end
    for line in (comment .. '\n'):gmatch('([^\n]*)\n') do
        local now = line:match('^  %- ') and 'list' or line:match('^  ') and 'indented' or 'prose'
        if line == '' then
            flush()
        else
            if now == 'indented' and kind == 'list' then
                now = 'list'
            end
            if kind and now ~= kind then
                flush()
            end
            kind = now
            lines[#lines + 1] = line
        end
    end
    flush()
    return blocks
end

-- Declarations alone: no bodies of functions, no lines for the preprocessor but public macros.
local function declarations(code)
    local kept, skipping = {}, 0
    for line in (code .. '\n'):gmatch('([^\n]*)\n') do
        if skipping > 0 then
            skipping = skipping + select(2, line:gsub('{', '')) - select(2, line:gsub('}', ''))
        elseif line:match('^#') and not line:match('^#define LMP_%u[%w_]*[%( ]') and
            line ~= '#define LMP_EXPERIMENTAL' then
            skipping = 0
        elseif line:match('%) {$') and not line:match('^typedef') and not line:match('^#') then
            kept[#kept + 1] = line:gsub(' {$', ';')
            skipping = 1
        else
            kept[#kept + 1] = line
        end
    end
    return (table.concat(kept, '\n'):gsub('LMP_API ', ''):gsub('^%s+', ''):gsub('%s+$', ''))
end

local function section(comment)
    local title, rest = comment:match('^%-%-%- (.-) %-+%s*(.*)$')
    if not title then
        return nil
    end
    return title:sub(1, 1):upper() .. title:sub(2), rest
end

function Reader(input)
    local text = tostring(input)
    local glsl = text:find('#ifndef LAMPION_GLSL', 1, true)
    local blocks, names, entries = {}, {}, 0
    local function append(list)
        for _, block in ipairs(list) do
            blocks[#blocks + 1] = block
        end
    end
    local title
    for _, group in ipairs(api.groups(text)) do
        local comment = group.comment
        local own = api.defined(group.code)
        local code = declarations(group.code)
        if not title then
            local what
            title, what, comment = (comment .. '\n\n'):match('^(%S+) %- (.-)\n\n(.*)$')
            blocks[#blocks + 1] = pandoc.Header(1, pandoc.Str(title:match('[^/]*$')))
            append({ pandoc.Para(inlines(what:sub(1, 1):upper() .. what:sub(2))) })
            append(comment_blocks(comment))
            blocks[#blocks + 1] = pandoc.Null() -- where the names go
            names.at, comment, code = #blocks, nil, ''
        end
        local heading, rest = section(comment or '')
        if heading then
            blocks[#blocks + 1] = pandoc.Header(2, inlines(heading),
                pandoc.Attr(heading:lower():gsub('%W+', '-')))
            comment = rest
        end
        local public = code:find('lmp_') or code:find('#define LMP_')
        if glsl then -- its macros are its own affair
            public = public and comment and not code:find('^#define')
        end
        local functions = select(2, group.code:gsub('LMP_API [%a]', ''))
        entries = entries + functions
        comment = comment ~= '' and comment or nil
        if functions > 0 and not comment then
            error('a function without a comment: ' .. group.code)
        end
        if comment and (public or heading or code == '' and not glsl) then
            append(comment_blocks(comment))
        end
        if public then
            local fresh = {} -- a function in two forms is listed once
            for _, name in ipairs(own) do
                fresh[name] = not anchored[name]
            end
            blocks[#blocks + 1] = pandoc.RawBlock('html', code_html(code, own))
            for _, name in ipairs(own) do
                if fresh[name] and name:match('^lmp_') and group.code:find(name .. '(', 1, true) then
                    names[#names + 1] = { pandoc.Plain({ pandoc.Link({ pandoc.Code(name) }, '#' .. name) }) }
                end
            end
        end
    end
    local declared = select(2, text:gsub('LMP_API [%a]', ''))
    if declared ~= entries then
        error(title .. ': ' .. declared .. ' functions are declared, ' .. entries .. ' were found')
    end
    if #names > 0 then
        local list = pandoc.BulletList({})
        for i, item in ipairs(names) do
            list.content[i] = item
        end
        blocks[names.at] = pandoc.Div({ list }, pandoc.Attr('', { 'names' }))
    end
    return pandoc.Pandoc(blocks, pandoc.Meta({ title = pandoc.MetaString(title) }))
end
