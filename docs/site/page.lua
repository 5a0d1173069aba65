-- SPDX-License-Identifier: MIT
-- Pandoc filter of every page: links between Markdown files become links between pages, names of
-- the library link to the API, wide tables scroll.
local api = dofile(PANDOC_SCRIPT_FILE:match('^(.*/)') .. 'api.lua')
local index = api.index()

-- Inline code that is one of the library's names, outside headings and other links.
local function link_names(element)
    local name = element.text:match('^(lmp_[%w_]+)$') or element.text:match('^(LMP_[%w_]+)$')
    local target = name and api.link(index, name)
    if target then
        return pandoc.Link({ pandoc.Code(element.text) }, target), false
    end
end

local links = {
    Link = function(link)
        local target, anchor = link.target:match('^([^#]*)(#?.*)$')
        if target ~= '' and not target:match('^%a+:') then
            link.target = api.page_of(target) .. anchor
        end
        return link
    end,
}

local names = {
    traverse = 'topdown',
    Link = function(link)
        return link, false
    end,
    Header = function(header)
        return header, false
    end,
    Code = link_names,
}

-- Browsers break a line after a hyphen, also after that of 1e-6.
local numbers = {
    Str = function(element)
        if element.text:match('^[%d.]+e%-%d+$') then
            return pandoc.Span({ element }, pandoc.Attr('', { 'number' }))
        end
    end,
}

local looks = {
    Table = function(element)
        return pandoc.Div({ element }, pandoc.Attr('', { 'wide' }))
    end,
    RawBlock = function(block)
        return block.text:match('^<!%-%-') and {} or nil
    end,
    -- a paragraph of images alone: a row that wraps
    Para = function(paragraph)
        for _, inline in ipairs(paragraph.content) do
            if inline.t ~= 'Image' and inline.t ~= 'SoftBreak' and inline.t ~= 'Space' then
                return nil
            end
        end
        return pandoc.Div({ pandoc.Plain(paragraph.content) }, pandoc.Attr('', { 'images' }))
    end,
}

-- The title is the first heading's.
local function title(document)
    for _, block in ipairs(document.blocks) do
        if block.t == 'Header' then
            document.meta.title = pandoc.MetaString(pandoc.utils.stringify(block.content))
            return document
        end
    end
end

-- A string of JavaScript.
local function quote(text)
    return '"' .. text:gsub('[%c"\\]', function(c)
        return ('\\u%04x'):format(c:byte())
    end) .. '"'
end

local function plain(blocks)
    local text = pandoc.walk_block(pandoc.Div(blocks), { Math = function(math) return pandoc.Str(math.text) end })
    return pandoc.write(pandoc.Pandoc({ text }), 'plain', { wrap_text = 'none' })
end

-- What the search finds, a line a section: its page, anchor, heading and text.
local function list_sections(document)
    local index = os.getenv('SEARCH_INDEX')
    if not index then
        return nil
    end
    local file = assert(io.open(index, 'a'))
    local section = { anchor = '', heading = document.meta.title, blocks = {} }
    local function write()
        local heading = pandoc.utils.stringify(section.heading)
        file:write('[', quote(os.getenv('PAGE')), ',', quote(section.anchor), ',', quote(heading), ',',
            quote(plain(section.blocks)), '],\n')
    end
    for _, block in ipairs(document.blocks) do
        if block.t == 'Header' and block.level > 1 then
            write()
            section = { anchor = block.identifier, heading = block.content, blocks = {} }
        elseif block.t ~= 'Header' then
            table.insert(section.blocks, block)
        end
    end
    write()
    file:close()
end

-- traverse = 'topdown' needs pandoc 2.17
return { { Pandoc = title }, { Pandoc = list_sections }, links, names, numbers, looks }
