# SPDX-License-Identifier: MIT
# The installed shaders in another language: awk -f variants.awk -v language=hlsl|metal -v folder=OUT FILE…
# writes OUT/FILE, an ending .glsl as .LANGUAGE. Names, macros and comments stay; what the languages
# write otherwise is translated line by line: names of types and functions, constructors, parameters
# that are written to, and the products with matrices.
#
# In HLSL the columns of a matrix are its rows: they are made, indexed and read alike, and the products
# exchange their sides.

# word(LINE, FROM, TO): replaces whole words.
function word(line, from, to,    done) {
    done = ""
    while (match(line, "(^|[^A-Za-z0-9_])" from "($|[^A-Za-z0-9_])")) {
        start = index(substr(line, RSTART), from) + RSTART - 1
        done = done substr(line, 1, start - 1) to
        line = substr(line, start + length(from))
    }
    return done line
}

# HLSL has no vector of one number: vec3(x) is ((float3)x).
function casts(line, type,    done) {
    done = ""
    while (match(line, "(^|[^A-Za-z0-9_])" type "\\([A-Za-z0-9_.]+\\)")) {
        start = index(substr(line, RSTART), type) + RSTART - 1
        end = RSTART + RLENGTH
        argument = substr(line, start + length(type) + 1, end - start - length(type) - 2)
        done = done substr(line, 1, start - 1) "((" type ")" argument ")"
        line = substr(line, end)
    }
    return done line
}

# Output parameters are references in Metal, and arrays are pointers.
function references(line,    done, before, parameter, after, part) {
    done = ""
    while (match(line, "(in [a-zA-Z_0-9]+ [a-zA-Z_0-9]+\\[[A-Z_]+\\]|(in)?out [a-zA-Z_0-9]+ [a-zA-Z_0-9]+(\\[[A-Z_]+\\])?|vec4 [a-z]+\\[3\\])[,)]")) {
        before = substr(line, 1, RSTART - 1)
        parameter = substr(line, RSTART, RLENGTH - 1)
        after = substr(line, RSTART + RLENGTH - 1)
        if (!sub("^(in|out|inout) ", "thread ", parameter))
            parameter = "constant " parameter
        split(parameter, part, /[ \[]/)
        done = done before part[1] " " part[2] " " (part[4] ? "*" : "&") part[3]
        line = after
    }
    return done line
}

function translate(line,    name) {
    gsub(/\.glsl/, "." language, line)
    if (line ~ /float\[LMP_BANDS\]\(/) { # an array's values
        sub(/float\[LMP_BANDS\]\(/, "{ ", line)
        sub(/\);/, " };", line)
        if (language == "hlsl")
            sub(/const/, "static const", line)
    }
    for (name in constructors)
        while (match(line, "(^|[^A-Za-z0-9_])" name "\\("))
            line = substr(line, 1, RSTART + RLENGTH - 2 - length(name)) "lmp_make" substr(line, RSTART + RLENGTH - length(name) + 2)
    if (language == "hlsl") {
        if (line ~ /^#define LMP_MATRIX_TIMES/)
            line = "#define LMP_MATRIX_TIMES(m, v) mul(v, m)"
        if (line ~ /^#define LMP_TIMES_MATRIX/)
            line = "#define LMP_TIMES_MATRIX(v, m) mul(m, v)"
        line = casts(casts(casts(casts(line, "vec3"), "vec2"), "mat3"), "LMP_EACH")
        line = word(word(line, "mix", "lerp"), "fract", "frac")
        line = word(line, "floatBitsToInt", "asint")
    } else {
        if (line ~ /^[a-z0-9]+ lmp_[a-z_]+\(.*\);$/) # members of a struct need no declaration before
            return ""
        line = references(line)
        line = word(line, "floatBitsToInt", "as_type<int>")
    }
    line = word(word(word(line, "vec2", "float2"), "vec3", "float3"), "vec4", "float4")
    return word(word(line, "ivec2", "int2"), "mat3", "float3x3")
}

# Returns the constructor of a struct, as a function.
function maker(name, members, count,    i, line, body) {
    line = body = ""
    for (i = 1; i <= count; i++) {
        line = line (i > 1 ? ", " : "") members[i]
        split(members[i], part, " ")
        body = body "    made." part[2] " = " part[2] ";\n"
    }
    return name " " constructors[name] "(" line ") {\n    " name " made;\n" body "    return made;\n}"
}

# "float a, b; ..." gives two members.
function add_members(line,    names, k, n, type) {
    sub(/;.*/, "", line)
    sub(/^ +/, "", line)
    type = line
    sub(/ .*/, "", type)
    n = split(substr(line, length(type) + 2), names, /, */)
    for (k = 1; k <= n; k++)
        members[++count] = type " " names[k]
}

# All structs must be known before the first line is written.
FNR == 1 {
    files[++file_count] = FILENAME
}
{
    lines[file_count, FNR] = $0
    length_of[file_count] = FNR
}
/^struct lmp_[a-z_]+ \{$/ {
    constructors[$2] = "lmp_make" substr($2, 4)
}

# Returns the first line after i that is not for GLSL alone, or i + 1.
function skip(file, i,    line) {
    line = lines[file, i + 1]
    if (line ~ /^ \* GLSL 4\.50, GLSL for Vulkan/)
        return i + 2
    if (line ~ /^ \* A fragment shader that is lit/)
        while (line !~ /What there is/)
            line = lines[file, ++i + 1]
    return i + 1
}

function write(file,    i, line, name, path) {
    path = files[file]
    sub(/.*\//, "", path)
    notice = "/* Made from " path " while Lampion is built. */"
    sub(/\.glsl$/, "." language, path)
    path = folder "/" path
    print lines[file, 1] "\n" notice > path
    for (i = skip(file, 1); i <= length_of[file]; i = skip(file, i)) {
        line = translate(lines[file, i])
        print line > path
        if (line ~ /^struct/) {
            split(line, part, " ")
            name = part[2]
            count = conditional = 0
        } else if (name != "" && line ~ /^#/) {
            conditional = 1
        } else if (name != "" && line ~ /^};/) {
            if (!conditional)
                print maker(name, members, count) > path
            name = ""
        } else if (name != "") {
            add_members(line)
        }
    }
    close(path)
}

END {
    for (file = 1; file <= file_count; file++)
        write(file)
}
