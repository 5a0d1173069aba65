/* SPDX-License-Identifier: MIT */
/* ui.cpp - Dear ImGui behind ui.h. Input does not come from ImGui's own backend for GLFW, which
 * would be linked to GLFW and would not see the events of scripts. */
#include "app/view/ui.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <imgui_internal.h>
#include <unistd.h>
#include <xxhash.h>

#include <bitset>

namespace {

constexpr float TEXT_PIXELS = 15; /* at 96 pixels per inch */
constexpr double SECONDS_MIN = 1e-4;

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
    double scale = 0;
    std::bitset<IM_UNICODE_CODEPOINT_MAX + 1> spelled; /* characters of all texts so far */
    bool complete = false;                             /* whether the font has those that exist */
};

interface *self;

const ImU32 colors[] = { IM_COL32(242, 242, 240, 255), IM_COL32(168, 176, 189, 255),
                         IM_COL32(255, 189, 97, 255), IM_COL32(13, 15, 20, 199),
                         IM_COL32(13, 15, 20, 237) };

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
    style.WindowRounding = style.FrameRounding = style.GrabRounding = 3;
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

bool ui_open(bool draws) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr; /* nothing is written into the user's folder */
    self = new interface;
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
        hash = XXH64(list->VtxBuffer.Data, static_cast<size_t>(list->VtxBuffer.size_in_bytes()), hash);
        hash = XXH64(list->IdxBuffer.Data, static_cast<size_t>(list->IdxBuffer.size_in_bytes()), hash);
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

void ui_ring(double x, double y, double radius) {
    ImDrawList *list = ImGui::GetBackgroundDrawList();
    const float scale = static_cast<float>(self->scale), r = static_cast<float>(radius);
    list->AddCircle(place(x, y), r, IM_COL32(0, 0, 0, 153), 0, 4 * scale);
    list->AddCircle(place(x, y), r, IM_COL32(255, 255, 255, 242), 0, 1.8f * scale);
}
