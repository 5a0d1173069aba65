# SPDX-License-Identifier: MIT
# view.sh PART: lampion view in a window. session: by real input, checked step by step, by its state and images;
# script, shadows, bounces, edit, export, nodes, aim: what scripts do; sidebar, handles: what the mouse does alone; refusals.
set -eu
. tests/checks/common.sh
. tests/program/window.sh
tries=600
# as in a container that grants less: the viewer's settings alone are 5 MB, and none lie on the stack
ulimit -s 4096
# leaks are looked for in view_memory.sh, for the driver has some
export ASAN_OPTIONS=detect_leaks=0
export LAMPION_GL_DEBUG=fatal XDG_CACHE_HOME="$WORK/cache" XDG_STATE_HOME="$WORK/state"
mkdir -p "$XDG_CACHE_HOME" "$XDG_STATE_HOME"
part=$1

# Without a display one line must say what to do instead.
status=0
(unset DISPLAY WAYLAND_DISPLAY; "$PROGRAM" view builtin:ball) 2>"$WORK/err" || status=$?
[ $status = 1 ] || fail "without a display: status $status"
[ "$(wc -l <"$WORK/err")" = 1 ] || fail "without a display: $(cat "$WORK/err")"
grep -q "lampion render" "$WORK/err" || fail "the way out is not named: $(cat "$WORK/err")"

if [ -z "${LAMPION_VIEW_DISPLAY:-}" ]; then
    export LAMPION_VIEW_DISPLAY=1
    exec xvfb-run -a -s "-screen 0 640x480x24" sh tests/program/view.sh "$part"
fi

cd "$WORK"
room='mtllib room.mtl
v -4 0 -4
v 4 0 -4
v 4 0 4
v -4 0 4
v -4 4 -4
v 4 4 -4
usemtl floor
f 4 3 2 1
usemtl wall
f 1 2 6 5'
printf '%s\n' "$room" >room.obj
printf 'newmtl floor\nKd 0.7 0.7 0.7\nnewmtl wall\nKd 0.8 0.3 0.2\n' >room.mtl
echo '{ "lights": [ { "position": [0, 1, 3], "radius": 0.2, "radiance": 20 },
    { "position": [-2, 2, 0], "radius": 0.1, "radiance": [5, 40, 80] } ] }' >lights.json

# value NAME: prints the first value of that name in the state.
value() {
    sed -n "s/^[[:space:]]*\"$1\":[[:space:]]*\(.*[^,]\),\{0,1\}$/\1/p" state.json 2>/dev/null | head -n 1
}

# place NAME: prints where the heading, button or handle is.
place() {
    tr -d '\n' <state.json 2>/dev/null | sed -n "s/.*\"$1\": *\[ *\([0-9]*\)[^,]*, *\([0-9]*\).*/\1 \2/p"
}
seen() { [ -n "$(place "$1")" ]; }

# second NAME: prints the value of the other side.
second() {
    sed -n "s/^[[:space:]]*\"$1\":[[:space:]]*\(.*[^,]\),\{0,1\}$/\1/p" state.json | sed -n 2p
}

is() { [ "$("$1" "$2")" = "$3" ]; }
isnt() { [ "$("$1" "$2")" != "$3" ]; }
says() { value message | grep -q "$1"; }

test_session() {
    shots=0
    # shot: takes a screenshot of the image as it is and waits for it; $image is its name.
    shot() {
        shots=$((shots + 1))
        image=$(printf 'lampion-%04d.png' $shots)
        xdotool key p
        until_true "screenshot $shots" test -s "$image"
    }

    "$PROGRAM" view room.obj --lights lights.json --eye 0,1,6 --target 0,1,0 --size 320x180 --samples 2 \
        --state state.json 2>view.err &
    viewer=$!
    trap 'kill $viewer 2>/dev/null || true' EXIT
    until_true "opening by the method of render" is value method '"zonal"'
    until_true "opening" is value height 180
    xdotool mousemove 20 20
    shot
    first=$image

    # the light in the middle of the image is dragged; the camera stays
    eye=$(value eye)
    position=$(value position)
    xdotool mousemove 160 90 mousedown 1 mousemove 180 80 mousemove 200 70 mouseup 1
    until_true "dragging a light" isnt value position "$position"
    until_true "selecting a light" is value selected 0
    is value eye "$eye" || fail "dragging a light moved the camera"
    shot
    cmp -s "$first" "$image" && fail "the dragged light is not to be seen"

    # the camera: orbit, fly, frame all
    xdotool mousemove 40 60 mousedown 1 mousemove 60 70 mousemove 90 80 mouseup 1
    until_true "orbiting" isnt value eye "$eye"
    eye=$(value eye)
    xdotool keydown w sleep 0.5 keyup w
    until_true "flying" isnt value eye "$eye"
    eye=$(value eye)
    xdotool key f
    until_true "framing" isnt value eye "$eye"
    eye=$(value eye)
    xdotool click 4
    until_true "zooming" isnt value eye "$eye"

    # lights: another one, larger, of another color, gone
    xdotool mousemove 160 120 key n
    until_true "adding a light" is value selected 2
    xdotool key bracketright h Delete
    until_true "removing a light" is value selected -1

    # shading
    xdotool key Up
    until_true "more bands" is value bands 11
    xdotool key g
    until_true "another window" is value window '"lanczos"'
    xdotool key m
    until_true "another method" is value method '"coefficients"'
    xdotool key period
    until_true "brighter" isnt value exposure 1

    # two sides: the pointer chooses
    xdotool key v
    until_true "splitting" is value split '"divided"'
    xdotool mousemove 300 60 key Down Down
    until_true "the right side" is second bands 9
    is value bands 11 || fail "the left side changed as well"
    xdotool mousemove 160 60 mousedown 1 mousemove 130 60 mousemove 100 60 mouseup 1
    until_true "the divider" isnt value divider 0.5
    shot
    split=$image
    xdotool key x
    until_true "the difference" is value split '"difference"'
    shot
    for name in "$split" "$image"; do
        "$PROGRAM" render --from "$name" -o again.png || fail "$name is not repeated"
        cmp "$name" again.png || fail "$name is repeated otherwise"
    done
    xdotool key x

    # time
    xdotool key space
    until_true "playing" isnt value seconds 0
    xdotool key space
    until_true "pausing" is value playing false

    # the window: another size, hidden and shown, the graphics again, the help
    window=$(xdotool search --name 'room.obj - Lampion' | tail -n 1)
    xdotool windowsize "$window" 400 240
    until_true "resizing" is value width 400
    xdotool windowunmap "$window" sleep 0.5 windowmap "$window" sleep 0.5 mousemove 200 120 key F1
    until_true "help" is value help true
    xdotool key Escape
    until_true "no help" is value help false
    xdotool key shift+F5
    until_true "starting again" says "graphics were started again"
    is value width 400 || fail "starting again lost the size"

    # the scene file: broken, it stays; mended, it is read again
    shot
    before=$image
    sleep 1
    echo 'f 1 2 99' >room.obj
    until_true "a broken scene" says "room.obj"
    says "read again" && fail "a broken scene was taken"
    printf '%s\n' "$room" | sed 's/^v -4 4 -4/v -4 2 -4/' >room.obj
    until_true "a mended scene" says "read again"
    shot
    cmp -s "$before" "$image" && fail "the new scene is not to be seen"

    xdotool key ctrl+q
    status=0
    wait $viewer || status=$?
    [ $status = 0 ] || fail "quitting: status $status: $(cat view.err)"
}

test_script() {
    # a script: dropped files, a recording; the same again gives the same
    cat >demo.txt <<'DEMO'
# the wall becomes a mirror, the camera orbits
0    move 80 30
0.1  drop ggx:0.2:0.9
0.2  key Page_Up
0.3  shot dropped.png
0.4  press left
0.5  move 120 40
0.6  release left
0.7  key space
1.0  shot after.png
1.1  key Ctrl+Q
DEMO
    for run in one two; do
        mkdir $run
        "$PROGRAM" view room.obj --lights lights.json --eye 0,1,6 --target 0,1,0 --size 160x90 \
            --samples 2 --script demo.txt --record $run --state state.json || fail "the script ends in $?"
        mv dropped.png after.png $run
    done
    grep -q '"wall=ggx:0.2:0.9"' state.json || fail "the dropped material is not in the state"
    cmp -s one/dropped.png one/after.png && fail "the script changes nothing"
    count=$(find one -name 'frame_*.png' | wc -l)
    [ "$count" -gt 20 ] || fail "only $count frames are recorded"
    diff -r one two || fail "two runs of a script differ"
    "$PROGRAM" render room.obj --from one/dropped.png -o again.png
    cmp one/dropped.png again.png || fail "an image with a dropped material is repeated otherwise"
}

test_shadows() {
    # shadows of a roof over the floor: a key, the option, and the image once more without a window
    printf '%s\nv -1 1 -1\nv 1 1 -1\nv 1 1 1\nv -1 1 1\nf 7 8 9 10\n' "$room" >roof.obj
    echo '{ "lights": [ { "position": [0.5, 3, 0], "radius": 0.3, "radiance": 40 } ] }' >over.json
    printf '0 shot lit.png\n0.1 key z\n0.4 shot shaded.png\n0.5 key z\n0.8 shot unshaded.png\n1 key Ctrl+Q\n' >shade.txt
    printf '0.3 shot option.png\n0.5 key Ctrl+Q\n' >option.txt
    roof="roof.obj --lights over.json --exposure 1 --eye 0,2.5,5 --target 0,0,0 --size 160x90 --samples 3"
    "$PROGRAM" view $roof --no-shadows --script shade.txt || fail "the script with shadows ends in $?"
    "$PROGRAM" view $roof --shadows --script option.txt || fail "a view with shadows ends in $?"
    "$PROGRAM" render --from shaded.png -o repeated.png
    cmp -s lit.png shaded.png && fail "the roof has no shadow"
    cmp shaded.png option.png || fail "the key and --shadows differ"
    cmp shaded.png repeated.png || fail "an image with shadows is repeated otherwise"
    "$PROGRAM" render --from unshaded.png -o repeated.png
    "$PROGRAM" view $roof --shadows --no-shadows --script shade.txt || fail "--no-shadows ends in $?"
    cmp unshaded.png repeated.png || fail "shadows do not go"
}

test_bounces() {
    # light that a floor reflects to the underside of a roof: a key, the option, and the image once more without a window
    printf '%s\nv -1 1 -1\nv 1 1 -1\nv 1 1 1\nv -1 1 1\nf 7 8 9 10\n' "$room" >roof.obj
    echo '{ "lights": [ { "position": [0.5, 3, 0], "radius": 0.3, "radiance": 40 } ] }' >over.json
    printf '0 shot direct.png\n0.1 key Z\n0.4 shot bounced.png\n0.5 key Z\n0.8 shot again.png\n1 key Ctrl+Q\n' >bounce.txt
    printf '0.3 shot option.png\n0.5 key Ctrl+Q\n' >option.txt
    roof="roof.obj --lights over.json --shadows --exposure 1 --eye 0,0.4,5 --target 0,0.4,0 --size 160x90 --samples 3"
    "$PROGRAM" view $roof --script bounce.txt || fail "the script with bounces ends in $?"
    "$PROGRAM" view $roof --bounces 8 --script option.txt || fail "a view with bounces ends in $?"
    "$PROGRAM" render --from bounced.png -o repeated.png
    "$PROGRAM" compare direct.png bounced.png --fail-above rmse=0.01 >differ.txt && fail "no light bounces"
    cmp bounced.png option.png || fail "the key and --bounces differ"
    cmp bounced.png repeated.png || fail "an image with bounces is repeated otherwise"
    "$PROGRAM" compare direct.png again.png --fail-above max=0 >differ.txt || fail "bounces do not go"
}

test_export() {
    # a copy of the scene has the lights of now, and so have the file of lights and what the actions write
    own_scene scene.gltf
    cat >many.json <<'LIGHTS'
{ "lights": [
  { "kind": "point", "position": [-2, 1, 0], "intensity": [3, 2, 1] },
  { "position": [2, 1.2, 0.5], "radius": 0.3, "radiance": [5, 9, 4] },
  { "kind": "spot", "position": [0, 2, 1], "direction": [0.3, -1, -0.2], "inner": 0.2, "outer": 0.7, "intensity": [2, 6, 9] },
  { "kind": "directional", "direction": [1, 2, 1], "irradiance": [0.3, 0.2, 0.1] },
  { "kind": "rectangle", "position": [0, 1.5, -1], "half_width": [0.5, 0.1, 0], "half_height": [-0.1, 0.5, 0.4], "two_sided": true,
    "radiance": [3, 1, 1] },
  { "kind": "disk", "position": [1, 0.8, 2], "direction": [0, -1, 0.4], "radius": 0.4, "radiance": [1, 2, 6] } ] }
LIGHTS
    printf '%s\n' '0 set lights/0/position -1, 1, 1' '0.1 export now.json' '0.2 export copy.gltf' '0.3 press "Export lights"' \
        '0.4 press "Export scene"' '0.6 key Ctrl+Q' >export.txt
    "$PROGRAM" view scene.gltf --lights many.json --size 64x36 --samples 1 --script export.txt --state state.json 2>view.err ||
        fail "exporting ends in $?: $(cat view.err)"
    says 'scene-lit-0001.gltf' || fail "the copy is not named: $(value message)"
    cmp copy.gltf scene-lit-0001.gltf || fail "the word and the action differ"
    cmp now.json lampion-lights-0001.json || fail "the word and the action give other lights"
    seen="--eye 0,3,6 --target 0,0.5,0 --exposure 1 --size 96x54 --samples 1 --environment none"
    "$PROGRAM" render scene.gltf --lights now.json $seen -q -o now.exr || fail "rendering the lights: $?"
    "$PROGRAM" render copy.gltf $seen -q -o copy.exr || fail "rendering the copy: $?"
    "$PROGRAM" compare copy.exr now.exr --fail-above max=1e-5 || fail "the copy is lit otherwise"
    python=$(python_with json)
    [ -z "$python" ] || "$python" - <<'PYTHON' || fail "another reader finds other lights"
import json
copy = json.load(open("copy.gltf"))
lights = copy["extensions"]["KHR_lights_punctual"]["lights"]
assert [light["type"] for light in lights] == ["point", "point", "spot", "directional"], lights
assert [light["intensity"] for light in lights][::2] == [3, 9] and lights[1]["extras"]["radius"] > 0.29, lights
areas = copy["extensions"]["EXT_lights_area"]["lights"]
assert [light["type"] for light in areas] == ["rect", "rect", "disk"], areas
assert set(copy["extensionsUsed"]) == set(copy["extensions"])
group = copy["nodes"][copy["scenes"][0]["nodes"][-1]]
assert [copy["nodes"][i]["matrix"][12:15] for i in group["children"]][0] == [-1, 1, 1], group
PYTHON
    # only glTF carries lights, and says what it cannot
    printf '0 press "Export scene"\n0.2 key Ctrl+Q\n' >scene.txt
    "$PROGRAM" view room.obj --lights lights.json --size 64x36 --script scene.txt --state state.json || fail "no glTF: $?"
    says 'Only glTF' || fail "nothing is said of other formats: $(value message)"
    printf '0 set lights/0/kind tube\n0.1 export tube.gltf\n0.3 key Ctrl+Q\n' >tube.txt
    "$PROGRAM" view scene.gltf --lights lights.json --size 64x36 --script tube.txt --state state.json 2>view.err || fail "a tube: $?"
    says 'without 1 tube' && grep -q 'tube.gltf: without 1 tube' view.err || fail "a tube is lost: $(value message)"
    for name in none/x.gltf scene.gltf; do
        printf '0 export %s\n' $name >bad.txt
        if "$PROGRAM" view scene.gltf --size 64x36 --script bad.txt 2>view.err; then fail "$name is written"; fi
        grep -q "$name" view.err || fail "$name: $(cat view.err)"
    done
    printf '0 export x.png\n' >bad.txt
    if "$PROGRAM" view scene.gltf --size 64x36 --script bad.txt 2>view.err; then fail "lights are exported to an image"; fi
}

test_nodes() {
    # what is hidden is as if it were not there: in the image, in its shadows, and in the image that --from repeats
    { sed '/usemtl wall/,$d' room.obj; } >floor.obj
    seen="--lights lights.json --eye 0,3,6 --target 0,1,0 --size 96x54 --samples 1 --shadows --environment none --framing outside"
    printf '0 shot whole.png\n0.2 set view/node 1\n0.3 press "Hide"\n0.5 shot hidden.png\n0.7 press "Show all"\n0.9 shot again.png\n1 key Ctrl+Q\n' >hide.txt
    printf '0 set view/node 0\n0.1 press "Isolate"\n0.4 shot alone.png\n0.5 key Ctrl+Q\n' >alone.txt
    printf '0.2 shot floor.png\n0.4 key Ctrl+Q\n' >floor.txt
    "$PROGRAM" view room.obj $seen --exposure 1 --script hide.txt --state state.json 2>view.err || fail "hiding ends in $?: $(cat view.err)"
    "$PROGRAM" view room.obj $seen --exposure 1 --script alone.txt || fail "isolating ends in $?"
    "$PROGRAM" view floor.obj $seen --exposure 1 --script floor.txt || fail "the floor ends in $?"
    same() { "$PROGRAM" compare "$1" "$2" --fail-above max=0 >compare.txt || fail "$1 and $2 differ: $(cat compare.txt)"; }
    same hidden.png floor.png
    same alone.png floor.png
    cmp whole.png again.png || fail "a node that was hidden and shown again leaves another image"
    cmp -s whole.png hidden.png && fail "nothing is hidden"
    "$PROGRAM" render --from hidden.png -o repeated.png || fail "rendering what is left: $?"
    cmp hidden.png repeated.png || fail "an image without a node is repeated otherwise"
    printf '0 press "Show all"\n0.3 shot shown.png\n0.4 key Ctrl+Q\n' >shown.txt
    "$PROGRAM" view --from hidden.png --script shown.txt || fail "going on from what is left: $?"
    same shown.png whole.png
}

test_aim() {
    # a light is dragged over the floor, by a key and by a word: the same; then one step back
    aim='room.obj --lights lights.json --eye 0,1,6 --target 0,1,0 --size 160x90 --samples 1'
    drag='0.2 move 70 70
0.3 press left
0.4 move 90 70
0.5 release left'
    printf '0 key Tab\n0.1 key 2\n%s\n1 key Ctrl+Q\n' "$drag" >key.txt
    printf '0 key Tab\n0.1 aim illumination\n%s\n1 key Ctrl+Q\n' "$drag" >word.txt
    printf '0 key Tab\n0.1 aim illumination\n%s\n0.6 key Ctrl+Z\n1 key Ctrl+Q\n' "$drag" >undone.txt
    printf '0 key Ctrl+Q\n' >nothing.txt
    for script in nothing key word undone; do
        "$PROGRAM" view $aim --script $script.txt --state state.json || fail "$script.txt ends in $?"
        value aim >$script.aim
        sed -n '/"lights"/,/^[[:space:]]*\]/p' state.json >$script.lights
    done
    [ "$(cat word.aim)" = '"illumination"' ] || fail "the aim is $(cat word.aim)"
    cmp -s nothing.lights key.lights && fail "the light has not moved"
    cmp key.lights word.lights || fail "the key and the word differ"
    cmp nothing.lights undone.lights || fail "a drag is not undone by one step"
    # which lights make a point of the floor: by a key and by a word
    printf '0 move 80 70\n0.1 key L\n0.3 key Ctrl+Q\n' >key.txt
    printf '0 move 80 70\n0.1 shares\n0.3 key Ctrl+Q\n' >word.txt
    for script in key word; do
        "$PROGRAM" view $aim --script $script.txt --state state.json || fail "$script.txt ends in $?"
        sed -n '/"shares"/,/^    }/p' state.json >$script.shares
        says ' % light [01] (sphere)' || fail "the shares are not told: $(value message)"
    done
    [ "$(grep -c '"percent"' key.shares)" -ge 2 ] || fail "the lights have no shares: $(cat key.shares)"
    cmp key.shares word.shares || fail "the key and the word differ"
    "$PROGRAM" view $aim --script nothing.txt --state state.json || fail "nothing.txt ends in $?"
    grep -q '"shares"' state.json && fail "shares are told that nobody asked for"
    printf '0 shares 1\n' >refused.txt
    "$PROGRAM" view $aim --script refused.txt 2>refused.err && fail "a word after shares is taken"
    grep -q 'line 1: shares' refused.err || fail "a word after shares: $(cat refused.err)"
}

test_edit() {
    # values that are typed, undo, lights saved and read again, another scene
    cat >edit.txt <<'EDIT'
0    key Tab
0.1  key Enter
0.2  key Down
0.3  type 0.5
0.4  key Enter
0.5  key Escape
0.6  key n
0.7  key Ctrl+Z
0.8  key Ctrl+S
0.9  shot edited.png
1.0  drop flag.stl
1.2  shot flag.png
1.3  drop builtin:ball
1.5  shot other.png
1.6  key Ctrl+O
1.7  type lampion-lights-0001.json
1.8  key Enter
1.9  key Ctrl+Q
EDIT
    facet='facet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 3\nendloop\nendfacet'
    printf "solid s\n$facet\nendsolid s\n" >flag.stl
    edit="--eye 0,1,6 --target 0,1,0 --size 160x90 --samples 1"
    "$PROGRAM" view room.obj --lights lights.json $edit --script edit.txt --state state.json || fail "editing ends in $?"
    is value scene '"builtin:ball"' || fail "the dropped scene is not opened: $(value scene)"
    [ "$(grep -c '"radius": 0.5$\|"radius":[[:space:]]*0.5,' lampion-lights-0001.json)" = 1 ] ||
        fail "the typed radius is not saved: $(cat lampion-lights-0001.json)"
    [ "$(grep -c '"kind"' lampion-lights-0001.json)" = 2 ] || fail "not two lights are saved"
    [ "$(grep -c '"kind"' state.json)" = 2 ] || fail "the saved lights are not read by Ctrl+O"
    for dropped in flag other; do # the first was rotated, because z is up in it
        "$PROGRAM" render --from $dropped.png -o again.png
        cmp $dropped.png again.png || fail "the image of a dropped scene, $dropped.png, is repeated otherwise"
    done
    for lights in edited.png lampion-lights-0001.json; do
        "$PROGRAM" render room.obj --lights "$lights" --size 32x18 -o "${lights%.*}-lit.png" || fail "--lights $lights: $?"
    done
    cmp edited-lit.png lampion-lights-0001-lit.png || fail "a screenshot and a file give other lights"
}

# Takes the screen; rests says whether it shows something, and the same as before; differs, whether
# it is another one.
rests() {
    mv -f "$1.ppm" before.ppm 2>/dev/null
    import -window root "$1.ppm"
    [ "$(identify -format %k "$1.ppm")" -gt 1 ] && cmp -s "$1.ppm" before.ppm
}
differs() {
    import -window root "$1.ppm"
    ! cmp -s "$1.ppm" "$2.ppm"
}

test_sidebar() {
    # actions by the mouse alone, by a key and by a script: the same settings
    click_on() {
        until_true "seeing $1" seen "$1"
        xdotool mousemove $(place "$1") click 1
    }
    # settings_of FILE: prints all that decides the image, and the selected light.
    settings_of() {
        sed '/"view":/,$d' "$1"
        grep '"selected":' "$1"
    }
    sized="room.obj --lights lights.json --framing outside --eye 0,1,6 --target 0,1,0 --size 640x480 --samples 1"
    # start FOLDER: opens a viewer, its sidebar folded as the window is narrow.
    start() {
        "$PROGRAM" view $sized --state state.json 2>view.err &
        viewer=$!
        trap 'kill $viewer 2>/dev/null || true' EXIT
        until_true "opening" is value height 480
        is value sidebar false || fail "a narrow window begins with the sidebar"
    }
    stop() {
        xdotool key ctrl+q
        wait $viewer || fail "quitting: $?: $(cat view.err)"
        rm state.json
    }

    start
    says 'F1 shows all keys' || fail "the first run tells no key: $(value message)"
    click_on Lampion # the title of the folded sidebar
    until_true "the sidebar" is value sidebar true
    is value message '""' || fail "a click does not end what the first run tells"
    click_on "Add light"
    until_true "adding a light by its button" is value selected 2
    click_on "Copy light"
    until_true "copying a light by its button" is value selected 3
    click_on Lights # folded again, so that what follows is not moved
    click_on Shading
    click_on "Next method"
    until_true "another method by its button" is value method '"coefficients"'
    xdotool mousemove 320 470 click 1 # a place of the sidebar without anything
    is value selected 3 || fail "a click on the sidebar reaches the image"
    settings_of state.json >by_button.txt
    stop

    start
    is value message '""' || fail "a later run tells what the first has told"
    xdotool mousemove 160 240 key n ctrl+d m
    until_true "another method by its key" is value method '"coefficients"'
    settings_of state.json >by_key.txt
    stop

    # the image beside the sidebar is the one without it, to the byte; what it covers is not
    if command -v import >/dev/null; then
        "$PROGRAM" view $sized --state state.json 2>view.err &
        viewer=$!
        until_true "all samples" is value sample 0
        xdotool mousemove 160 240 key i
        until_true "no statistics" is value overlay false
        until_true "no image on the screen" rests without
        xdotool key F3
        until_true "the sidebar by its key" is value sidebar true
        until_true "no sidebar on the screen" differs beside without
        until_true "no sidebar at rest" rests beside
        for side in without beside; do
            convert $side.ppm -crop 320x480+0+0 +repage ${side}320.png
        done
        "$PROGRAM" compare without320.png beside320.png --fail-above max=0 >compare.txt ||
            fail "the image beside the sidebar is another one: $(cat compare.txt)"
        stop
    else
        echo "skipped: import is not installed (package imagemagick)"
    fi

    printf '0 move 160 240\n0.1 press "Add light"\n0.2 press "Copy light"\n0.3 press "Next method"\n0.5 key Ctrl+Q\n' >press.txt
    "$PROGRAM" view $sized --script press.txt --state state.json || fail "the script ends in $?"
    settings_of state.json >by_script.txt
    # values by their names, and the command that makes the image
    cat >set.txt <<'SET'
0    set lights/0/radius 0.3
0.1  set looks/0/bands 20
0.2  set materials/wall ggx:0.2:0.9
0.3  press "Split"
0.4  press "Copy command"
0.5  key Ctrl+Q
SET
    "$PROGRAM" view $sized --script set.txt --state state.json || fail "the script of values ends in $?"
    is value radius 0.3 || fail "the radius is $(value radius)"
    is value bands 20 || fail "there are $(value bands) bands"
    command=$(value message | sed -n 's/^"Copied: lampion \(.*\)"$/\1/p')
    [ -n "$command" ] || fail "no command: $(value message)"
    "$PROGRAM" $command || fail "the command ends in $?: $command"
    cmp lampion-0001.png again.png || fail "the command makes another image"
    printf '0 set looks/0/bands none\n0.2 key Ctrl+Q\n' >set.txt
    "$PROGRAM" view $sized --script set.txt --state state.json || fail "a value that cannot be ends the script: $?"
    value message | grep -q bands || fail "nothing is said of bands: $(value message)"

    diff by_button.txt by_key.txt || fail "buttons and keys differ"
    diff by_key.txt by_script.txt || fail "keys and scripts differ"
}

test_handles() {
    # the light's arrow is dragged by the mouse, by steps while Ctrl is held, and undone; no screenshot shows a handle
    sized="room.obj --lights lights.json --framing outside --eye 0,1,6 --target 0,1,0 --size 640x480 --samples 1"
    "$PROGRAM" view $sized --state state.json 2>view.err &
    viewer=$!
    trap 'kill $viewer 2>/dev/null || true' EXIT
    until_true "opening" is value height 480
    xdotool mousemove 40 440 key Tab
    until_true "seeing the arrow" seen x
    xdotool key p
    until_true "a screenshot with handles" test -s lampion-0001.png
    xdotool key ctrl+h
    hidden() { ! seen x; }
    until_true "no handles" hidden
    xdotool key p
    until_true "a screenshot without handles" test -s lampion-0002.png
    cmp lampion-0001.png lampion-0002.png || fail "handles are in a screenshot"
    xdotool key ctrl+h
    until_true "seeing the arrow again" seen x

    position=$(value position)
    start=$(place x)
    column=${start% *}
    row=${start#* }
    xdotool mousemove $start mousedown 1 mousemove $((column + 10)) $row mousemove $((column + 41)) $row
    # the light has come to rest: its arrow is where the pointer is
    arrived() { [ "$(place x)" = "$((column + 41)) $row" ] || [ "$(place x)" = "$((column + 40)) $row" ]; }
    until_true "dragging the arrow" arrived
    dragged=$(value position)
    xdotool keydown ctrl
    until_true "steps" isnt value position "$dragged"
    stepped=$(value position)
    echo "$stepped" | grep -q '^\[0\.[1-9], 1, 3\]$' || fail "steps of 0.1 lead to $stepped"
    xdotool mouseup 1 keyup ctrl key ctrl+z
    until_true "undoing" is value position "$position"
    xdotool key ctrl+q
    wait $viewer || fail "quitting: $?: $(cat view.err)"

    # the same by a script
    cat >drag.txt <<DRAG
0   key Tab
0.1 move $start
0.2 press left
0.3 move $((column + 41)) $row
0.4 hold ctrl
0.5 release left
0.6 free ctrl
0.7 key Ctrl+Q
DRAG
    "$PROGRAM" view $sized --script drag.txt --state state.json || fail "the script ends in $?"
    is value position "$stepped" || fail "the script leads to $(value position), not $stepped"
}

test_refusals() {
    # refusals
    refused() {
        status=0
        "$PROGRAM" "$@" >out 2>err || status=$?
        [ $status != 0 ] && [ $status -lt 126 ] || fail "$*: status $status"
        [ "$(wc -l <err)" = 1 ] || fail "$*: not one line: $(cat err)"
    }
    refused view
    refused view none.obj
    refused view room.obj --script none.txt
    refused view builtin:ball --animate none.json
    refused view --from room.obj
    small="room.obj --framing outside --lights lights.json --size 80x60 --frames 9"
    printf '0 shot none/x.png\n' >bad.txt
    refused view $small --script bad.txt
    grep -q 'none/x.png' err || fail "not the image's fault: $(cat err)"
    refused view $small --record room.obj
    refused view $small --state none/state.json
    printf '0 shot first.png\n1 key Ctrl+Q\n' >first.txt
    "$PROGRAM" view $small --script first.txt || fail "an image of the first frame: $?"
    [ -s first.png ] || fail "no image of the first frame"
    "$PROGRAM" render room.obj --size 8x8 -o plain.png 2>/dev/null
    refused render --from plain.png -o x.png
    refused render room.obj --lights plain.png -o x.png
    refused render --from first.png -o x.exr
    [ ! -e x.png ] || fail "a refusal left an image"
}

test_$part
