-- SPDX-License-Identifier: MIT
-- What the site knows of the library's names: which page of the API defines which. The headers are
-- those named in the environment variable API_SOURCES, relative to the folder pandoc runs in.
local api = {}

function api.read(path)
    local file = assert(io.open(path, 'r'))
    local text = file:read('a')
    file:close()
    return text
end

-- Does this line, at the outermost level of a file, open something that is closed further down?
local function depth_after(depth, line)
    local code = line:gsub('/%*.-%*/', ''):gsub('".-"', '')
    for brace in code:gmatch('[{}]') do
        depth = depth + (brace == '{' and 1 or -1)
    end
    return depth
end

-- A file as a list of { comment = text or nil, code = text }, one for each group of lines between
-- blank lines, license, includes and guards left out. A comment that stands alone has code ''.
function api.groups(text)
    text = text:gsub('#ifdef __cplusplus\n.-#endif\n', ''):gsub('^/%* SPDX.-%*/\n', '')
    local groups, comment, code = {}, {}, {}
    local in_comment, depth = false, 0
    local function flush()
        if #comment + #code > 0 then
            groups[#groups + 1] = { comment = #comment > 0 and table.concat(comment, '\n') or nil,
                                    code = table.concat(code, '\n') }
        end
        comment, code = {}, {}
    end
    for line in text:gmatch('([^\n]*)\n') do
        if in_comment or (depth == 0 and line:match('^/%*') and not line:match('^/%*.-%*/.')) then
            if not in_comment and #code > 0 then
                flush()
            end
            in_comment = not line:match('%*/%s*$')
            comment[#comment + 1] = line:gsub('^/%*%s?', ''):gsub('%s*%*/%s*$', ''):gsub('^ %* ?', '')
        elseif line == '' and depth == 0 then
            flush()
        else
            code[#code + 1] = line
            if not line:match('^#') then
                depth = depth_after(depth, line)
            end
        end
    end
    flush()
    return groups
end

-- Names that a group's code defines, in order.
function api.defined(code)
    local names, seen = {}, {}
    local function add(name)
        if name and not seen[name] then
            seen[name] = true
            names[#names + 1] = name
        end
    end
    local flat = code:gsub('/%*.-%*/', '')
    for line in (flat .. '\n'):gmatch('([^\n]*)\n') do
        add(line:match('^#define (LMP_[%w_]+)'))
        add(line:match('^} (lmp_[%w_]+);'))
        add(line:match('^typedef .-%(%*(lmp_[%w_]+)%)'))
        add(line:match('^typedef struct lmp_[%w_]+ (lmp_[%w_]+);'))
        add(line:match('^struct (lmp_[%w_]+) {'))
        if line:match('^typedef enum') then
            add(line:match('} (lmp_[%w_]+);'))
            for list in line:gmatch('{(.-)}') do
                for name in list:gmatch('LMP_[%w_]+') do
                    add(name)
                end
            end
        elseif not line:match('^[#%s}]') and not line:match('^typedef') then
            add(line:match('(lmp_[%w_]+)%('))
        end
        add(line:match('^%s+(LMP_[A-Z%d_]+)[%s,=]') or line:match('^%s+(LMP_[A-Z%d_]+)$'))
    end
    return names
end

-- name → page (a source's path): the first source that defines it.
function api.index()
    local index = {}
    for path in os.getenv('API_SOURCES'):gmatch('%S+') do
        for _, group in ipairs(api.groups(api.read(path))) do
            for _, name in ipairs(api.defined(group.code)) do
                -- the macros of a shader are its own affair
                if not (path:match('%.glsl$') and name:match('^LMP_')) then
                    index[name] = index[name] or path
                end
            end
        end
    end
    return index
end

-- The page of the site that a file of the repository becomes; other files keep their names.
function api.page_of(path)
    local page = path:gsub('README%.md$', 'index.html'):gsub('%.md$', '.html')
    for source in os.getenv('API_SOURCES'):gmatch('%S+') do
        if path:sub(-#source) == source then
            page = path .. '.html'
        end
    end
    return page
end

function api.link(index, name)
    local page = index[name]
    return page and (os.getenv('ROOT') .. api.page_of(page) .. '#' .. name)
end

return api
