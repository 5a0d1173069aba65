# SPDX-License-Identifier: MIT
# Does what the preprocessor of GLSL does, for wgsl.awk: code[k] is the text of files[k], file_count of them. What
# is before the first directive is left out, and of a macro's comment nothing is left.
#   - a macro of bands, LMP_FOR_…, is a loop over them;
#   - a macro that is a number stands as "const NAME = NUMBER;";
#   - every other macro is replaced.

BEGIN {
    split("LMP_BANDS LMP_WINDOW LMP_WINDOW_SIZE LMP_LIGHT_COUNT LMP_LIGHT_FIXED LMP_LIGHT_COLOR LMP_LIGHT_LIT " \
          "LMP_AREA_COUNT LMP_GGX_TEXEL LMP_FOR_BANDS LMP_FOR_COLUMN LMP_FOR_COLUMNS LMP_BAND LMP_INDEX " \
          "LMP_HALF_INDEX LMP_INSIDE", given, " ")
    for (i in given)
        defined[given[i]] = 1
    split("LMP_FOR_BANDS LMP_FOR_COLUMN LMP_FOR_COLUMNS LMP_BAND LMP_INDEX LMP_HALF_INDEX", bands, " ")
    for (i in bands)
        builtin[bands[i]] = 1
    name_pattern = "[A-Za-z_][A-Za-z0-9_]*"
}

# --- directives and macros --------------------------------------------------------------------------

# Returns the arguments that begin after the parenthesis text begins with, as argument[1 …]; sets
# rest_of_call to what follows.
function split_call(text, argument,    depth, i, c, count, start) {
    depth = 0
    start = 2
    for (i = 1; i <= length(text); i++) {
        c = substr(text, i, 1)
        if (c == "(" || c == "[")
            depth++
        else if (c == ")" || c == "]")
            depth--
        if (depth == 0 || (depth == 1 && c == ",")) {
            argument[++count] = trim(substr(text, start, i - start))
            start = i + 1
        }
        if (depth == 0)
            break
    }
    rest_of_call = substr(text, i + 1)
    return count
}

function trim(text) {
    gsub(/^[ \n]+|[ \n]+$/, "", text)
    return text
}

# The macros of bands, whose bodies begin with a test of the band, as loops.
function loop_of(name, argument,    body, variable, first, test) {
    body = bodies[argument[1]]
    variable = name == "LMP_FOR_COLUMNS" ? "m" : "l"
    first = name == "LMP_FOR_BANDS" ? 2 : name == "LMP_FOR_COLUMN" ? "m" : 0
    first = "for (int " variable " = " first "; " variable " < LMP_BANDS; " variable "++)"
    test = name == "LMP_FOR_COLUMN" ? "if \\(LMP_INSIDE\\(l, m\\)\\)" : "if \\(" variable " < LMP_BANDS\\)"
    if (!sub(test, first, body))
        body = first " {\n" body "\n}"
    return trim(body)
}

function index_of(name, argument) {
    if (name == "LMP_BAND") # an index that stays legal where there is one band
        return argument[1] == "1" ? "min(1, LMP_BANDS - 1)" : argument[1]
    if (name == "LMP_HALF_INDEX")
        return "l * (l + 1) / 2 + m"
    return argument[2] == "m" ? "l * l + l + m" : "l * l + l - m"
}

function call_macro(name, text,    argument, parameter, count, i, body, done, inner) {
    count = split_call(text, argument)
    done = rest_of_call
    if (name ~ /^LMP_FOR_/)
        body = loop_of(name, argument)
    else if (name in builtin)
        body = index_of(name, argument)
    else {
        split(parameters[name], parameter, " ")
        for (i = 1; i <= count; i++)
            inner[parameter[i]] = argument[i]
        body = substitute(bodies[name], inner)
    }
    body = expand(body)
    rest_of_call = done
    return body
}

# Replaces names by values.
function substitute(text, values,    done, name) {
    while (match(text, name_pattern)) {
        name = substr(text, RSTART, RLENGTH)
        done = done substr(text, 1, RSTART - 1) (name in values ? values[name] : name)
        text = substr(text, RSTART + RLENGTH)
    }
    return done text
}

# Replaces macros outside comments.
function expand(text,    done, name, end) {
    while (match(text, "/\\*|" name_pattern)) {
        name = substr(text, RSTART, RLENGTH)
        done = done substr(text, 1, RSTART - 1)
        text = substr(text, RSTART + RLENGTH)
        if (name == "/*") {
            end = index(text, "*/") + 1
            done = done "/*" substr(text, 1, end)
            text = substr(text, end + 1)
        } else if ((name in parameters || name in builtin) && substr(text, 1, 1) == "(") {
            name = call_macro(name, text)
            text = rest_of_call
            done = done name
        } else
            done = done (name in bodies && !(name in parameters) ? expand(bodies[name]) : name)
    }
    return done text
}

function define(line,    name, body, comment) {
    sub(/^#define +/, "", line)
    match(line, name_pattern)
    name = substr(line, 1, RLENGTH)
    line = substr(line, RLENGTH + 1)
    if (name in builtin) {
        forget_comment()
        return
    }
    defined[name] = 1
    if (substr(line, 1, 1) == "(") {
        forget_comment()
        match(line, /\)/)
        parameters[name] = substr(line, 2, RSTART - 2)
        gsub(/,/, " ", parameters[name])
        bodies[name] = trim(substr(line, RSTART + 1))
        return
    }
    if (match(line, / *\/\*.*\*\//)) {
        comment = substr(line, RSTART)
        line = substr(line, 1, RSTART - 1)
    }
    body = trim(line)
    if (name ~ /^LOOKUP_|^LMP_EACH/)
        bodies[name] = body
    else if (body != "")
        add_text("const " name " = " body ";" comment "\n")
}

# What is said about a macro that is replaced means nothing.
function forget_comment(    text, end) {
    text = code[file_count]
    if (text !~ /\*\/[ \n]*$/)
        return
    for (end = length(text); substr(text, end, 2) != "/*"; end--)
        ;
    code[file_count] = substr(text, 1, end - 1)
}

function holds(condition) {
    if (condition ~ /^#ifdef/)
        return word_of(condition) in defined
    if (condition ~ /^#ifndef/)
        return !(word_of(condition) in defined)
    return condition ~ /LMP_LOBES == 1/ && !("LAMPION_GGX_GLSL" in defined)
}

function word_of(line,    part) {
    split(line, part, /[ \t]+/)
    return part[2]
}

function add_text(text) {
    code[file_count] = code[file_count] text
}

function flush() {
    add_text(expand(pending))
    pending = ""
}

# Directives nest: state[depth] is 1 where lines count, 0 where they do not yet, -1 not any more.
function directive(line) {
    flush()
    if (line ~ /^#if/) {
        depth++
        state[depth] = state[depth - 1] == 1 ? holds(line) : -1
    } else if (line ~ /^#el/)
        state[depth] = state[depth] == 0 && (line ~ /^#else/ || holds(line)) ? 1 : -1
    else if (line ~ /^#endif/)
        depth--
    else if (state[depth] == 1 && line ~ /^#define/)
        define(line)
    else if (state[depth] == 1 && line ~ /^#undef/) {
        delete bodies[word_of(line)]
        delete parameters[word_of(line)]
    }
}

FNR == 1 {
    files[++file_count] = FILENAME
    head = 1
    state[depth = 0] = 1
}
/^#/ {
    head = 0
    logical = ""
    continued = 1
}
head { # what is before the first directive is about GLSL
    next
}
continued {
    continued = /\\$/
    line = $0
    sub(/ *\\$/, "", line)
    logical = logical (logical == "" ? "" : "\n") line
    if (!continued)
        directive(logical)
    next
}
state[depth] == 1 {
    pending = pending $0 "\n"
}
