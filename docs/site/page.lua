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

-- traverse = 'topdown' needs pandoc 2.17
return { { Pandoc = title }, links, names, looks }
