# SPDX-License-Identifier: MIT
# The installed shaders in WGSL: awk -v folder=OUT -f glsl.awk -f wgsl.awk FILE… writes OUT/NAME.wgsl of each file,
# the name without its ending. WGSL has no preprocessor, so what the directives decide is decided here:
# with ggx.glsl among the files lobes are those of GGX, else one of Phong.
#
# Names and comments stay. Differences in meaning between the languages decide the rest:
#   - a function that returns what the includer defined is omitted: the user of WGSL defines it;
#   - functions are not overloaded: the last parameter's type ends the name of those that are in GLSL;
#   - parameters that are written to are pointers; others are constant, and copied where GLSL changes them;
#   - c ? a : b is select(b, a, c), which evaluates all three, or an if statement where it is returned.

BEGIN {
    split("float f32 int i32 bool bool vec2 vec2f vec3 vec3f vec4 vec4f ivec2 vec2i mat3 mat3x3f", pair, " ")
    for (i = 1; i in pair; i += 2)
        types[pair[i]] = pair[i + 1]
    split("from pass", word, " ") # names that WGSL reserves
    for (i in word)
        reserved[word[i]] = 1
    overloads["lmp_lobes_of"] = 2 # in a build without GGX, too
}

# --- tokens -----------------------------------------------------------------------------------------

# Appends tokens of text: token[n], and in gap[n] the spaces and comments before it.
function scan(text,    space, end, length_of) {
    while (text != "") {
        space = ""
        while (match(text, /^([ \n]+|\/\*)/)) {
            end = RLENGTH
            if (substr(text, 1, 2) == "/*")
                end = index(text, "*/") + 1
            space = space substr(text, 1, end)
            text = substr(text, end + 1)
        }
        if (text == "")
            return
        if (match(text, "^" name_pattern) || match(text, /^[0-9.]+(e-?[0-9]+)?f?/) ||
            match(text, /^(<<|\+\+|&&|\|\||[-+*\/<>=!]=)/))
            length_of = RLENGTH
        else
            length_of = 1
        token[++n] = substr(text, 1, length_of)
        gap[n] = space
        text = substr(text, length_of + 1)
    }
}

# Returns the token that closes what token i opens.
function close_of(i,    depth) {
    for (depth = 0; i <= n; i++) {
        if (token[i] ~ /^[([{]$/)
            depth++
        else if (token[i] ~ /^[])}]$/ && --depth == 0)
            return i
    }
}

# Returns the first token from a to b that is `wanted` (a pattern) and in no parentheses, or 0.
function find(wanted, a, b,    i) {
    for (i = a; i <= b; i++) {
        if (token[i] ~ wanted)
            return i
        if (token[i] ~ /^[([{]$/)
            i = close_of(i)
    }
    return 0
}

# --- declarations -----------------------------------------------------------------------------------

# Reads the parameters between parentheses into out[k], type[k], name[k]; returns their count.
function read_parameters(open, out, type, name,    i, k, close_at) {
    close_at = close_of(open)
    for (i = open + 1; i < close_at; i++) {
        k++
        out[k] = token[i] ~ /out$/
        if (token[i] ~ /^(in|out|inout)$/)
            i++
        type[k] = token[i++]
        name[k] = token[i++]
        if (token[i] == "[") {
            type[k] = "array<" type_of(type[k]) ", " expression(i + 1, close_of(i) - 1) ">"
            i = close_of(i) + 1
        }
    }
    return k
}

function type_of(name) {
    return name in types ? types[name] : name
}

# Whether the function's body only returns what the includer defined.
function is_hook(open,    body, end) {
    body = close_of(open) + 1
    end = token[body + 3] == "(" ? close_of(body + 3) + 1 : body + 3
    return token[body + 1] == "return" && token[body + 2] ~ /^LMP_/ && end == close_of(body) - 1
}

# Notes what calls need to know about a function.
function note_function(i,    out, type, name, count, k) {
    count = read_parameters(i + 2, out, type, name)
    returned[token[i + 1]] = token[i]
    for (k = 1; k <= count; k++)
        if (out[k])
            writes[token[i + 1], k] = 1
    if (token[close_of(i + 2) + 1] == "{")
        overloads[token[i + 1]]++
}

function full_name(name, type) {
    if (overloads[name] < 2)
        return name
    sub(/^lmp_/, "", type)
    return name "_" type
}

# Returns the type of what the tokens from a to b are: a variable's, or what a call returns.
function type_of_value(a, b) {
    if (a == b)
        return variables[token[a]]
    return token[a] in returned ? returned[token[a]] : token[a]
}

# --- expressions ------------------------------------------------------------------------------------

function expression(a, b,    question, colon, nested, i) {
    question = find("^[?]$", a, b)
    if (!question)
        return operands(a, b)
    nested = 0
    for (i = question + 1; i <= b; i++) {
        if (token[i] ~ /^[([]$/)
            i = close_of(i)
        else if (token[i] == "?")
            nested++
        else if (token[i] == ":" && nested-- == 0)
            break
    }
    colon = i
    return gap[a] "select(" trim(expression(colon + 1, b)) ", " trim(expression(question + 1, colon - 1)) ", " \
        trim(expression(a, question - 1)) ")"
}

function operands(a, b,    i, done, end) {
    for (i = a; i <= b; i++) {
        if (token[i] ~ /^[A-Za-z_]/ && token[i + 1] == "(" && i < b) {
            done = done call(i)
            i = close_of(i + 1)
        } else if (token[i] ~ /^[([]$/) {
            end = close_of(i)
            done = done gap[i] token[i] expression(i + 1, end - 1) gap[end] token[end]
            i = end
        } else
            done = done gap[i] (token[i - 1] == "." ? token[i] : plain(token[i]))
    }
    return done
}

function plain(name) {
    if (name in pointers)
        return "(*" renamed(name) ")"
    return name in reserved ? renamed(name) : name
}

function renamed(name) {
    return name in reserved ? name "_" : name
}

function call(i,    name, close_at, a, b, k, done) {
    name = token[i]
    close_at = close_of(i + 1)
    for (a = i + 2; a < close_at; a = b + 1) {
        b = find("^,$", a, close_at - 1)
        if (!b)
            b = close_at
        k++
        done = done (k > 1 ? "," : "") ((name, k) in writes ? gap[a] reference(a, b - 1) : expression(a, b - 1))
        if (b == close_at && overloads[name] > 1)
            name = full_name(name, type_of_value(a, b - 1))
    }
    if (name == "mat3" && trim(done) == "0.0") # all zeros
        done = ""
    if (name == "floatBitsToInt")
        name = "bitcast<i32>"
    return gap[i] type_of(name) "(" done ")"
}

function reference(a, b) {
    return a == b && token[a] in pointers ? token[a] : "&" trim(expression(a, b))
}

# --- statements -------------------------------------------------------------------------------------

# Sets at to the first token after the statement that it begins with.
function statement(    a, b, done) {
    a = at
    if (token[a] == "{")
        return block()
    if (token[a] == "if") {
        b = close_of(a + 1)
        at = b + 1
        done = gap[a] "if (" expression(a + 2, b - 1) ") " braced()
        if (token[at] != "else")
            return done
        at++
        return done " else " (token[at] == "if" ? trim(statement()) : braced())
    }
    if (token[a] == "for") {
        b = close_of(a + 1)
        at = a + 2
        done = gap[a] "for (" trim(simple(find("^;$", at, b))) ";"
        at = find("^;$", a + 2, b) + 1
        b = find("^;$", at, b)
        done = done expression(at, b - 1) ";"
        at = b + 1
        b = close_of(a + 1)
        done = done gap[at] assignment(at, b - 1) ") "
        at = b + 1
        return done braced()
    }
    b = find("^;$", a, n)
    done = simple(b)
    at = b + 1
    return done (done ~ /}$/ ? "" : ";")
}

function braced() {
    return token[at] == "{" ? trim(block()) : "{" statement() "\n}"
}

function block(    done, end) {
    end = close_of(at)
    done = gap[at++] "{"
    while (at < end)
        done = done statement()
    at = end + 1
    return done gap[end] "}"
}

# What ends with a semicolon, at b, without it.
function simple(b,    a, space) {
    a = at
    space = gap[a]
    gap[a] = ""
    if (token[a] == "return")
        return space returned_choice(a + 1, b - 1)
    if (token[a + 1] ~ /^[A-Za-z_]/)
        return space declaration(a, b)
    return space assignment(a, b - 1)
}

function returned_choice(a, b,    question, colon) {
    question = find("^[?]$", a, b)
    if (!question)
        return "return" expression(a, b)
    colon = find("^:$", question, b)
    return "if (" trim(expression(a, question - 1)) ") {\nreturn " trim(expression(question + 1, colon - 1)) \
        ";\n}\n" returned_choice(colon + 1, b)
}

# "float a = x, b[3];" declares two variables.
function declaration(a, b,    type, first, next_at, equal, name, done, end) {
    type = token[a]
    for (first = a + 1; first < b; first = next_at + 1) {
        next_at = find("^,$", first, b - 1)
        if (!next_at)
            next_at = b
        name = token[first]
        variables[name] = type
        done = done (done == "" ? "" : ";\n") "var " renamed(name) ": "
        if (token[first + 1] == "[") {
            end = close_of(first + 1)
            done = done "array<" type_of(type) ", " expression(first + 2, end - 1) ">"
        } else
            done = done type_of(type)
        equal = find("^=$", first, next_at - 1)
        if (equal)
            done = done " =" expression(equal + 1, next_at - 1)
    }
    return done
}

# "a = b = x" assigns x to b first.
function assignment(a, b,    equal, second) {
    equal = find("^[-+*/]?=$", a, b)
    if (!equal)
        return trim(expression(a, b))
    second = find("^=$", equal + 1, b)
    if (second)
        return assignment(equal + 1, b) ";\n" trim(expression(a, equal - 1)) " = " trim(expression(equal + 1, second - 1))
    return trim(expression(a, equal - 1)) gap[equal] token[equal] expression(equal + 1, b)
}

# --- the top level ----------------------------------------------------------------------------------

# Whether the tokens from a to b change the parameter.
function is_changed(name, a, b,    i, k, j) {
    for (i = a; i <= b; i++) {
        if (token[i] != name || token[i - 1] == ".")
            continue
        for (j = i + 1; token[j] == "."; j += 2)
            ;
        if (token[j] ~ /^[-+*\/]?=$/)
            return 1
        if (token[i - 1] == "(" && (token[i - 2], 1) in writes)
            return 1
    }
    return 0
}

function signature(i, out, type, name, count, changed,    k, done, declared) {
    for (k = 1; k <= count; k++) {
        declared = type_of(type[k])
        if (out[k])
            declared = "ptr<function, " declared ">"
        done = done (k > 1 ? ", " : "") renamed(name[k]) (changed[k] ? "_" : "") ": " declared
    }
    return "fn " full_name(token[i + 1], type[count]) "(" done ")" \
        (token[i] == "void" ? "" : " -> " type_of(token[i]))
}

function write_function(i,    out, type, name, changed, count, k, open, copies) {
    count = read_parameters(i + 2, out, type, name)
    open = close_of(i + 2) + 1
    if (token[open] == ";") { # declared before it is defined, which WGSL does not need
        if (token[i + 1] == "lmp_areas_shade")
            write_no_areas(signature(i, out, type, name, count, changed))
        at = open + 1
        return ""
    }
    split("", pointers)
    split("", variables)
    for (k = 1; k <= count; k++) {
        changed[k] = !out[k] && is_changed(name[k], open, close_of(open))
        variables[name[k]] = type[k]
        if (changed[k])
            copies = copies "\n    var " name[k] " = " renamed(name[k]) "_;"
    }
    if (is_hook(i + 2)) {
        hooks = hooks "\n *     " signature(i, out, type, name, count, changed)
        at = close_of(open) + 1
        return ""
    }
    for (k = 1; k <= count; k++)
        if (out[k])
            pointers[name[k]] = 1
    copies = gap[i] signature(i, out, type, name, count, changed) " {" copies
    at = open
    return copies substr(trim(block()), 2) "\n"
}

# What stands for area.wgsl where there is none.
function write_no_areas(declared) {
    print "/* SPDX-License-Identifier: MIT */\n/* no_areas.wgsl stands for area.wgsl where no light is an area. */\n" \
        declared " {\n    return vec3f(0.0);\n}" > (folder "/no_areas.wgsl")
}

function write_struct(i,    end, a, b, k, done) {
    end = close_of(i + 2)
    done = gap[i] "struct " token[i + 1] " {"
    for (a = i + 3; a < end; a = b + 1) {
        b = find("^;$", a, end)
        done = done gap[a]
        for (k = a + 1; k < b; k += 2)
            done = done (k > a + 1 ? " " : "") token[k] ": " type_of(token[a]) ","
    }
    at = end + 2
    return done gap[end] "}\n"
}

# Indents by the braces that are open, and further where a line goes on.
function indented(text,    line, count, i, depth, done, goes_on, comment, members) {
    count = split(text, line, "\n")
    for (i = 1; i <= count; i++) {
        comment = line[i] ~ /^ *(\/\*|\*)/
        sub(/^ +/, "", line[i])
        if (line[i] ~ /^}/)
            depth--
        done = done (i > 1 ? "\n" : "") (line[i] == "" ? "" : sprintf("%" 4 * (depth + goes_on) "s", "") \
            (line[i] ~ /^\*/ ? " " : "") line[i])
        if (comment || line[i] == "")
            continue
        sub(/ *\/\*.*/, "", line[i])
        members = line[i] ~ /^struct/ || (members && line[i] !~ /^}/)
        if (line[i] ~ /[{]$/)
            depth++
        goes_on = line[i] !~ /[;{}]$/ && !members
    }
    return done
}

function write_file(file,    path, done, name, text) {
    path = files[file]
    sub(/.*\//, "", path)
    name = path
    sub(/\.[a-z]+$/, "", name)
    hooks = name == "lampion" ? "\n *     const LMP_BANDS, LMP_WINDOW, LMP_WINDOW_SIZE" : ""
    for (at = first_token[file]; at < first_token[file + 1];) {
        if (token[at] == "struct")
            text = write_struct(at)
        else if (token[at] == "const") {
            text = gap[at] "const " token[at + 1] " =" expression(at + 3, find("^;$", at, n) - 1) ";"
            at = find("^;$", at, n) + 1
        } else
            text = write_function(at)
        done = done text
    }
    gsub(/\.glsl/, ".wgsl", done)
    gsub(/\n\n\n+/, "\n\n", done)
    text = "/* SPDX-License-Identifier: MIT */\n/* " name ".wgsl, made from " path ", which says more, while Lampion is built."
    if (hooks != "")
        text = text "\n *\n * You define" hooks "\n"
    print text " */\n" indented(done) > (folder "/" name ".wgsl")
}

END {
    for (file = 1; file <= file_count; file++) {
        first_token[file] = n + 1
        scan(code[file])
    }
    first_token[file] = n + 1
    for (i = 1; i <= n; i++) {
        if (token[i] == "struct")
            i = close_of(i + 2) + 1
        else if (token[i] == "const")
            i = find("^;$", i, n)
        else if (token[i + 2] == "(") {
            note_function(i)
            i = close_of(i + 2) + 1
            if (token[i] == "{")
                i = close_of(i)
        }
    }
    for (file = 1; file <= file_count; file++)
        write_file(file)
}
