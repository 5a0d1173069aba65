/* SPDX-License-Identifier: MIT */
/* ui.cpp - Dear ImGui behind ui.h. Input does not come from ImGui's own backend for GLFW, which
 * would be linked to GLFW and would not see the events of scripts. */
#include "app/view/ui.h"

#include "app/image/srgb.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <imgui_internal.h>
#include <unistd.h>
#include <xxhash.h>

#include <bitset>
#include <cstring>
#include <string>
#include <unordered_map>

namespace {

constexpr float TEXT_PIXELS = 15; /* at 96 pixels per inch */
constexpr double SECONDS_MIN = 1e-4;
constexpr int UI_PATH_MAX = 64;

/* Fonts where Debian, Fedora and Arch have them. Each gives the characters that those before it
 * lack. */
const char *const fonts[] = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf",
    "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
    "/usr/share/fonts/google-noto/NotoSans-Regular.ttf",
    "/usr/share/fonts/noto/NotoSans-Regular.ttf",
    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
    "/usr/share/fonts/truetype/noto/NotoSansArabic-Regular.ttf",
    "/usr/share/fonts/truetype/noto/NotoSansHebrew-Regular.ttf",
    "/usr/share/fonts/truetype/noto/NotoSansDevanagari-Regular.ttf",
    "/usr/share/fonts/truetype/noto/NotoSansThai-Regular.ttf",
    "/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc",
    "/usr/share/fonts/google-noto-cjk/NotoSansCJK-Regular.ttc",
    "/usr/share/fonts/noto-cjk/NotoSansCJK-Regular.ttc",
    "/usr/share/fonts/truetype/wqy/wqy-zenhei.ttc",
    "/usr/share/fonts/truetype/droid/DroidSansFallbackFull.ttf",
};

struct interface {
    bool draws;
    void (*copy)(const char *text);
    const char *(*paste)(void);
    double scale = 0;
    std::bitset<IM_UNICODE_CODEPOINT_MAX + 1> spelled; /* characters of all texts so far */
    bool complete = false;                             /* whether the font has those that exist */
    std::unordered_map<std::string, ImVec2> places;    /* of headings and buttons */
    int skipped = 0; /* items of the list before the next one, that are not seen */
    ImVec2 below;    /* where the widget after the last button goes, unless beside it */
};

interface *self;

const ImU32 colors[] = { IM_COL32(242, 242, 240, 255), IM_COL32(168, 176, 189, 255),
                         IM_COL32(255, 189, 97, 255),  IM_COL32(13, 15, 20, 199),
                         IM_COL32(13, 15, 20, 237),    IM_COL32(240, 84, 84, 255),
                         IM_COL32(120, 206, 84, 255),  IM_COL32(84, 148, 255, 255) };

/* --- the font --------------------------------------------------------------------------------- */

/* Sees to it that the font of the next frame has the characters of a text. */
void spell(const char *text) {
    while (*text) {
        unsigned c;
        text += ImTextCharFromUtf8(&c, text, nullptr);
        if (c < self->spelled.size() && !self->spelled[c]) {
            self->spelled.set(c);
            self->complete = false;
        }
    }
}

bool lacks_glyphs(const ImFont *font) {
    for (size_t c = ' '; c < self->spelled.size(); c++)
        if (self->spelled[c] && !font->FindGlyphNoFallback(static_cast<ImWchar>(c)))
            return true;
    return false;
}

/* Makes the font of the characters that were spelled, from as few files as have them all. Without
 * files it is ImGui's own, which has Latin letters. */
void make_font() {
    ImFontAtlas *atlas = ImGui::GetIO().Fonts;
    ImVector<ImWchar> ranges;
    ImFontGlyphRangesBuilder builder;
    ImFontConfig config;
    const float pixels = TEXT_PIXELS * static_cast<float>(self->scale);
    builder.AddRanges(atlas->GetGlyphRangesDefault());
    for (size_t c = 0; c < self->spelled.size(); c++)
        if (self->spelled[c])
            builder.AddChar(static_cast<ImWchar>(c));
    builder.BuildRanges(&ranges);
    atlas->Clear();
    atlas->Flags |= ImFontAtlasFlags_NoPowerOfTwoHeight;
    for (const char *file : fonts) {
        if (access(file, R_OK) != 0)
            continue;
        atlas->AddFontFromFileTTF(file, pixels, &config, ranges.Data);
        config.MergeMode = true;
        if (atlas->Build() && !lacks_glyphs(atlas->Fonts[0]))
            break;
    }
    if (!config.MergeMode) {
        config.SizePixels = pixels;
        atlas->AddFontDefault(&config);
    }
    atlas->Build();
    self->complete = true;
    if (self->draws) {
        ImGui_ImplOpenGL3_DestroyFontsTexture();
        ImGui_ImplOpenGL3_CreateFontsTexture();
    }
}

/* --- the style -------------------------------------------------------------------------------- */

void set_scale(double scale) {
    ImGuiStyle style;
    ImGui::StyleColorsDark(&style);
    /* square corners: on software, rounding all buttons costs 2 ms a frame */
    style.ScaleAllSizes(static_cast<float>(scale));
    ImGui::GetStyle() = style;
    self->scale = scale;
    self->complete = false;
}

ImVec2 place(double x, double y) {
    return ImVec2(static_cast<float>(x), static_cast<float>(y));
}

} // namespace

/* --- frames ----------------------------------------------------------------------------------- */

bool ui_open(bool draws, void (*copy)(const char *text), const char *(*paste)(void)) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr; /* nothing is written into the user's folder */
    self = new interface;
    self->copy = copy;
    self->paste = paste;
    if (copy && paste) {
        ImGui::GetIO().SetClipboardTextFn = [](void *, const char *text) { self->copy(text); };
        ImGui::GetIO().GetClipboardTextFn = [](void *) { return self->paste(); };
    }
    self->draws = draws && ImGui_ImplOpenGL3_Init("#version 450");
    if (self->draws || !draws)
        return true;
    ui_close();
    return false;
}

void ui_close() {
    if (!self)
        return;
    if (self->draws)
        ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
    delete self;
    self = nullptr;
}

void ui_begin(int width, int height, double scale, double seconds) {
    ImGuiIO &io = ImGui::GetIO();
    if (self->scale != scale)
        set_scale(scale);
    if (!self->complete)
        make_font();
    io.DisplaySize = place(width, height);
    io.DeltaTime = static_cast<float>(seconds > SECONDS_MIN ? seconds : SECONDS_MIN);
    self->places.clear();
    if (self->draws)
        ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
}

uint64_t ui_end() {
    ImGui::Render();
    const ImDrawData *drawn = ImGui::GetDrawData();
    XXH64_hash_t hash = 0;
    for (int i = 0; i < drawn->CmdListsCount; i++) {
        const ImDrawList *list = drawn->CmdLists[i];
        hash =
            XXH64(list->VtxBuffer.Data, static_cast<size_t>(list->VtxBuffer.size_in_bytes()), hash);
        hash =
            XXH64(list->IdxBuffer.Data, static_cast<size_t>(list->IdxBuffer.size_in_bytes()), hash);
        for (const ImDrawCmd &command : list->CmdBuffer)
            hash = XXH64(&command.ClipRect, sizeof command.ClipRect, hash);
    }
    return hash;
}

void ui_draw() {
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

const char *ui_version() {
    return ImGui::GetVersion();
}

/* --- input ------------------------------------------------------------------------------------ */

void ui_move(double x, double y) {
    ImGui::GetIO().MousePos = place(x, y);
}

void ui_press(int button, bool down) {
    static const int buttons[] = { 0, 2, 1 }; /* ImGui's right one comes before the middle one */
    ImGui::GetIO().MouseDown[buttons[button]] = down;
}

void ui_scroll(double steps) {
    ImGui::GetIO().MouseWheel += static_cast<float>(steps);
}

void ui_type(const char *text) {
    spell(text);
    ImGui::GetIO().AddInputCharactersUTF8(text);
}

bool ui_key(const char *name, bool down) {
    static const struct {
        const char *name;
        ImGuiKey key;
    } keys[] = { { "Tab", ImGuiKey_Tab },
                 { "Left", ImGuiKey_LeftArrow },
                 { "Right", ImGuiKey_RightArrow },
                 { "Up", ImGuiKey_UpArrow },
                 { "Down", ImGuiKey_DownArrow },
                 { "Page_Up", ImGuiKey_PageUp },
                 { "Page_Down", ImGuiKey_PageDown },
                 { "Home", ImGuiKey_Home },
                 { "End", ImGuiKey_End },
                 { "Delete", ImGuiKey_Delete },
                 { "Backspace", ImGuiKey_Backspace },
                 { "Enter", ImGuiKey_Enter },
                 { "Escape", ImGuiKey_Escape },
                 { "Ctrl+A", ImGuiKey_A },
                 { "Ctrl+C", ImGuiKey_C },
                 { "Ctrl+V", ImGuiKey_V },
                 { "Ctrl+X", ImGuiKey_X },
                 { "Ctrl+Y", ImGuiKey_Y },
                 { "Ctrl+Z", ImGuiKey_Z } };
    ImGuiIO &io = ImGui::GetIO();
    io.KeyShift = down && strncmp(name, "Shift+", 6) == 0;
    io.KeyCtrl = down && strncmp(name, "Ctrl+", 5) == 0;
    for (const auto &row : keys)
        if (strcmp(row.name, strncmp(name, "Shift+", 6) == 0 ? name + 6 : name) == 0) {
            io.KeyMap[row.key] = row.key;
            io.KeysDown[row.key] = down;
            return true;
        }
    return false;
}

bool ui_covers(double x, double y) {
    for (const ImGuiWindow *window : ImGui::GetCurrentContext()->Windows)
        if (window->Active && !window->Hidden &&
            !(window->Flags & ImGuiWindowFlags_NoMouseInputs) &&
            window->OuterRectClipped.Contains(place(x, y)))
            return true;
    return ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup);
}

bool ui_covered() {
    const ImVec2 at = ImGui::GetIO().MousePos;
    return ui_covers(static_cast<double>(at.x), static_cast<double>(at.y));
}

bool ui_takes_text() {
    const ImGuiContext *context = ImGui::GetCurrentContext();
    /* what ImGui wants is a frame late when a field has been left */
    return context->IO.WantTextInput && context->ActiveId != 0 &&
           context->ActiveId == context->InputTextState.ID;
}

/* --- widgets ---------------------------------------------------------------------------------- */

namespace {

/* Returns the stored value of a linear one, the inverse of image_srgb_to_linear. */
float to_stored(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * powf(linear, 1 / 2.4f) - 0.055f;
}

/* Remembers where the last widget is, if it is seen. */
void mark(const char *name) {
    const ImVec2 lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
    if (ImGui::IsItemVisible())
        self->places[name] = ImVec2(0.5f * (lo.x + hi.x), 0.5f * (lo.y + hi.y));
}

} // namespace

bool ui_sidebar_begin(const char *title, double width, bool *open) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float folded = ImGui::CalcTextSize(title).x + 3 * ImGui::GetFontSize();
    const float wide = *open ? static_cast<float>(width) : folded;
    ImGui::SetNextWindowPos(ImVec2(screen.x - wide, 0));
    ImGui::SetNextWindowSize(ImVec2(wide, screen.y));
    ImGui::SetNextWindowCollapsed(!*open);
    ImGui::SetNextWindowBgAlpha(0); /* the image is cut off there */
    const bool seen = ImGui::Begin(title, nullptr,
                                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                       ImGuiWindowFlags_NoSavedSettings);
    const ImRect bar = ImGui::GetCurrentWindow()->TitleBarRect();
    self->places[title] = ImVec2(bar.Min.x + 0.5f * bar.GetHeight(), bar.GetCenter().y);
    *open = !ImGui::IsWindowCollapsed();
    ImGui::PushItemWidth(0.56f * static_cast<float>(width));
    return seen;
}

void ui_sidebar_end() {
    ImGui::PopItemWidth();
    ImGui::End();
}

bool ui_section(const char *title, bool open) {
    spell(title);
    const bool seen = ImGui::CollapsingHeader(title, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
    mark(title);
    return seen;
}

bool ui_button(const char *name, const char *tip, bool on) {
    const ImGuiStyle &style = ImGui::GetStyle();
    const float needed = ImGui::CalcTextSize(name).x + 2 * style.FramePadding.x;
    const ImGuiWindow *window = ImGui::GetCurrentWindow();
    if (window->DC.CursorPos.y == self->below.y && window->DC.CursorPos.x == self->below.x &&
        window->DC.CursorPosPrevLine.x + style.ItemSpacing.x + needed < window->WorkRect.Max.x)
        ImGui::SameLine();
    spell(name);
    spell(tip);
    if (on)
        ImGui::PushStyleColor(ImGuiCol_Button, style.Colors[ImGuiCol_ButtonActive]);
    const bool pressed = ImGui::Button(name);
    if (on)
        ImGui::PopStyleColor();
    mark(name);
    self->below = window->DC.CursorPos;
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s", tip);
    return pressed;
}

void ui_text(const char *text) {
    spell(text);
    ImGui::TextUnformatted(text);
}

bool ui_numbers(const char *name, float *numbers, int count, float minimum, float maximum,
                float step) {
    const bool changed =
        ImGui::DragScalarN(name, ImGuiDataType_Float, numbers, count, step, &minimum, &maximum,
                           "%.5g", ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoRoundToFormat);
    mark(name);
    return changed;
}

bool ui_integer(const char *name, int *number, int minimum, int maximum) {
    const bool changed =
        ImGui::SliderInt(name, number, minimum, maximum, "%d", ImGuiSliderFlags_AlwaysClamp);
    mark(name);
    return changed;
}

bool ui_flag(const char *name, bool *on) {
    const bool changed = ImGui::Checkbox(name, on);
    mark(name);
    return changed;
}

bool ui_choice(const char *name, const char *const *choices, int *chosen) {
    int count = 0;
    while (choices[count])
        spell(choices[count++]);
    const bool changed = ImGui::Combo(name, chosen, choices, count, 12);
    mark(name);
    return changed;
}

bool ui_tint(const char *name, float rgb[3]) {
    float stored[3]; /* as a screen shows it */
    for (int k = 0; k < 3; k++)
        stored[k] = to_stored(rgb[k]);
    const bool changed =
        ImGui::ColorEdit3(name, stored,
                          ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoLabel |
                              ImGuiColorEditFlags_NoOptions | ImGuiColorEditFlags_PickerHueWheel);
    mark(name);
    for (int k = 0; changed && k < 3; k++)
        rgb[k] = static_cast<float>(image_srgb_to_linear(static_cast<double>(stored[k])));
    ImGui::SameLine();
    return changed;
}

bool ui_line(const char *name, char *text, size_t size, bool live) {
    spell(text);
    const bool changed =
        ImGui::InputText(name, text, size, live ? 0 : ImGuiInputTextFlags_EnterReturnsTrue);
    mark(name);
    return changed;
}

void ui_list_begin(const char *name, int rows) {
    ImGui::BeginChild(name,
                      ImVec2(0, static_cast<float>(rows) * ImGui::GetTextLineHeightWithSpacing() +
                                    2 * ImGui::GetStyle().WindowPadding.y),
                      true);
}

namespace {

/* Returns what the library knows an item of a tree by. */
const void *item_pointer(long number) {
    return reinterpret_cast<const void *>(number);
}

/* Leaves the places of items that are not seen empty, all at once. */
void skip_items() {
    const float line = ImGui::GetTextLineHeightWithSpacing();
    if (self->skipped > 0)
        ImGui::Dummy(
            ImVec2(1, line * static_cast<float>(self->skipped) - ImGui::GetStyle().ItemSpacing.y));
    self->skipped = 0;
}

/* Returns where the next item begins, from the upper edge of the window. */
float next_item() {
    return ImGui::GetCursorScreenPos().y +
           ImGui::GetTextLineHeightWithSpacing() * static_cast<float>(self->skipped);
}

/* Returns the length of a name up to the ## after which it is not shown. */
int shown_length(const char *name) {
    return static_cast<int>(ImGui::FindRenderedTextEnd(name) - name);
}

/* Shows the whole of a text that the list has no room for, from a place on. */
void show_whole(const char *text, float from) {
    const float end = from + ImGui::CalcTextSize(text, nullptr, true).x;
    if (ImGui::IsItemHovered() && end > ImGui::GetCurrentWindow()->ClipRect.Max.x)
        ImGui::SetTooltip("%.*s", shown_length(text), text);
}

} // namespace

bool ui_sees_item() {
    const ImRect &seen = ImGui::GetCurrentWindow()->ClipRect;
    const float y = next_item();
    if (y <= seen.Max.y && y + ImGui::GetTextLineHeight() >= seen.Min.y) {
        skip_items();
        return true;
    }
    self->skipped++;
    return false;
}

void ui_reveal_item() {
    ImGui::SetScrollFromPosY(next_item() - ImGui::GetWindowPos().y);
}

bool ui_item(const char *text, bool chosen) {
    spell(text);
    const bool pressed = ImGui::Selectable(text, chosen);
    mark(text);
    show_whole(text, ImGui::GetItemRectMin().x);
    return pressed;
}

bool ui_tree_item(long number, const char *text, int depth, bool has_more, bool chosen) {
    const float indent = static_cast<float>(depth) * 0.8f * ImGui::GetFontSize() + 0.01f;
    spell(text);
    ImGui::Indent(indent);
    const bool was_open = ui_is_open(number);
    ImGui::TreeNodeEx(item_pointer(number),
                      ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_NoTreePushOnOpen |
                          ImGuiTreeNodeFlags_SpanAvailWidth |
                          (has_more ? 0 : ImGuiTreeNodeFlags_Leaf) |
                          (chosen ? ImGuiTreeNodeFlags_Selected : 0),
                      "%.*s", shown_length(text), text);
    mark(text);
    show_whole(text, ImGui::GetItemRectMin().x + ImGui::GetTreeNodeToLabelSpacing());
    const bool pressed = ImGui::IsItemClicked() && ui_is_open(number) == was_open;
    ImGui::Unindent(indent);
    return pressed;
}

bool ui_is_open(long number) {
    return ImGui::TreeNodeBehaviorIsOpen(ImGui::GetID(item_pointer(number)));
}

void ui_open_item(long number) {
    ImGui::GetStateStorage()->SetBool(ImGui::GetID(item_pointer(number)), true);
}

void ui_list_end() {
    skip_items();
    ImGui::EndChild();
}

void ui_image(const float *rgb, int size) {
    /* rectangles, which need no texture and are part of the frame's hash */
    const float pixel = static_cast<float>(self->scale), wide = pixel * static_cast<float>(size);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImDrawList *list = ImGui::GetWindowDrawList();
    ImGui::Dummy(ImVec2(wide, wide));
    for (int i = 0; i < size * size && ImGui::IsItemVisible(); i++, rgb += 3) {
        const ImVec2 at(corner.x + pixel * static_cast<float>(i % size),
                        corner.y + pixel * static_cast<float>(i / size));
        if (rgb[0] >= 0)
            list->AddRectFilled(at, ImVec2(at.x + pixel, at.y + pixel),
                                ImGui::ColorConvertFloat4ToU32(ImVec4(
                                    to_stored(rgb[0]), to_stored(rgb[1]), to_stored(rgb[2]), 1)));
    }
}

void ui_graph(const char *name, const float *numbers, int count, float maximum) {
    ImGui::PlotLines("", numbers, count, 0, name, 0, maximum,
                     ImVec2(ImGui::GetContentRegionAvail().x, 4 * ImGui::GetFontSize()));
}

bool ui_find(const char *name, double *x, double *y) {
    const auto found = self->places.find(name);
    if (found == self->places.end())
        return false;
    *x = static_cast<double>(found->second.x);
    *y = static_cast<double>(found->second.y);
    return true;
}

/* --- drawings --------------------------------------------------------------------------------- */

double ui_text_height() {
    return static_cast<double>(ImGui::GetFontSize());
}

void ui_measure(const char *text, double size, double room, double *width, double *height) {
    const float pixels = static_cast<float>(size) * ImGui::GetFontSize();
    spell(text);
    const ImVec2 extent =
        ImGui::GetFont()->CalcTextSizeA(pixels, FLT_MAX, static_cast<float>(room), text);
    *width = static_cast<double>(extent.x);
    *height = static_cast<double>(extent.y);
}

void ui_write(double x, double y, const char *text, double size, double room, ui_color color) {
    spell(text);
    ImGui::GetBackgroundDrawList()->AddText(
        ImGui::GetFont(), static_cast<float>(size) * ImGui::GetFontSize(), place(x, y),
        colors[color], text, nullptr, static_cast<float>(room));
}

void ui_box(double x, double y, double width, double height, double radius, ui_color color) {
    ImGui::GetBackgroundDrawList()->AddRectFilled(place(x, y), place(x + width, y + height),
                                                  colors[color], static_cast<float>(radius));
}

void ui_path(const float (*points)[2], int count, ui_shape shape, double width, ui_color color,
             double opacity) {
    ImDrawList *list = ImGui::GetBackgroundDrawList();
    ImVec2 path[UI_PATH_MAX];
    const int used = count < UI_PATH_MAX ? count : UI_PATH_MAX;
    for (int i = 0; i < used; i++)
        path[i] = ImVec2(points[i][0], points[i][1]);
    const auto faded = [opacity](ImU32 solid) {
        ImVec4 rgba = ImGui::ColorConvertU32ToFloat4(solid);
        rgba.w *= static_cast<float>(opacity);
        return ImGui::ColorConvertFloat4ToU32(rgba);
    };
    const auto wide = static_cast<float>(width * self->scale);
    const auto edge = wide + 2.2f * static_cast<float>(self->scale);
    const ImDrawFlags closed = shape == UI_OPEN ? ImDrawFlags_None : ImDrawFlags_Closed;
    list->AddPolyline(path, used, faded(IM_COL32(0, 0, 0, 153)), closed, edge);
    if (shape == UI_FILLED)
        list->AddConvexPolyFilled(path, used, faded(colors[color]));
    else
        list->AddPolyline(path, used, faded(colors[color]), closed, wide);
}
