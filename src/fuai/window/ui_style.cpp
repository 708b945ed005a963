// Fonts by fontconfig, colours of two themes.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/ui_style.h"

#include <fontconfig/fontconfig.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "fuai/units/kes.h"
#include "fuai/window/error_text.h"
#include "fuai/window/ui_text.h"

namespace fuai {
namespace {

/// Characters that labels are made of besides letters.
constexpr const char* kSymbols = "●·²³°×−→←↑↓±²⁻⁰¹²³⁴⁵⁶⁷⁸⁹…—–“”";

/// The file of the font that matches a pattern best and has a language; empty when there is none.
std::string find_font(const char* pattern, const char* language) {
  const std::unique_ptr<FcConfig, void (*)(FcConfig*)> config(FcInitLoadConfigAndFonts(), FcConfigDestroy);
  if (!config) return {};
  const auto text = [](const char* t) { return reinterpret_cast<const FcChar8*>(t); };
  const std::unique_ptr<FcPattern, void (*)(FcPattern*)> wanted(FcNameParse(text(pattern)), FcPatternDestroy);
  FcConfigSubstitute(config.get(), wanted.get(), FcMatchPattern);
  FcDefaultSubstitute(wanted.get());
  FcResult result = FcResultNoMatch;
  const std::unique_ptr<FcPattern, void (*)(FcPattern*)> found(
      FcFontMatch(config.get(), wanted.get(), &result), FcPatternDestroy);
  if (!found) return {};
  // What matches best need not have the language.
  FcLangSet* languages = nullptr;
  if (FcPatternGetLangSet(found.get(), FC_LANG, 0, &languages) != FcResultMatch ||
      FcLangSetHasLang(languages, text(language)) == FcLangDifferentLang)
    return {};
  FcChar8* file = nullptr;
  if (FcPatternGetString(found.get(), FC_FILE, 0, &file) != FcResultMatch) return {};
  return reinterpret_cast<const char*>(file);
}

}  // namespace

ImU32 to_ui_colour(const Colour& c, double alpha) {
  return ImGui::ColorConvertFloat4ToU32({static_cast<float>(c.red), static_cast<float>(c.green),
                                         static_cast<float>(c.blue), static_cast<float>(c.alpha * alpha)});
}

std::string load_fonts(float size, const std::string& more) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  ImFontGlyphRangesBuilder builder;
  builder.AddRanges(atlas.GetGlyphRangesDefault());
  // Names of files and fabrics may be Japanese, too.
  builder.AddRanges(atlas.GetGlyphRangesJapanese());
  builder.AddText(kSymbols);
  builder.AddText(more.c_str());
  for (const UiText& text : ui_texts()) {
    builder.AddText(text.english);
    builder.AddText(text.japanese);
  }
  for (const ErrorSentence& sentence : error_sentences()) builder.AddText(sentence.japanese);
  for (const KesQuantity& q : kes_quantities())
    for (const std::string_view text : {q.name_ja, q.definition_ja})
      builder.AddText(text.data(), text.data() + text.size());
  static ImVector<ImWchar> ranges;  // the atlas reads it until it is built, and does not copy it
  ranges.clear();
  builder.BuildRanges(&ranges);
  const std::string file = find_font("sans:lang=ja", "ja");
  if (!file.empty() && atlas.AddFontFromFileTTF(file.c_str(), size, nullptr, ranges.Data) != nullptr) {
    // Fonts for Japanese have no raised minus.
    static constexpr ImWchar kRaised[] = {0x2070, 0x207f, 0};
    const std::string other = find_font("DejaVu Sans", "en");
    ImFontConfig merged;
    merged.MergeMode = true;
    if (!other.empty()) atlas.AddFontFromFileTTF(other.c_str(), size, &merged, kRaised);
    atlas.Build();
    return {};
  }
  ImFontConfig config;
  config.SizePixels = size;
  atlas.AddFontDefault(&config);
  atlas.Build();
  return "no font with Japanese was found: install fonts-noto-cjk; Japanese texts show as question marks";
}

Colour background_colour(bool dark) {
  return dark ? Colour{0.13, 0.14, 0.16, 1.0} : Colour{0.96, 0.96, 0.95, 1.0};
}

Colour ground_colour(bool dark) {
  return dark ? Colour{0.25, 0.26, 0.28, 1.0} : Colour{0.88, 0.88, 0.87, 1.0};
}

ImVec4 assumed_colour(bool dark) {
  return dark ? ImVec4(0.95F, 0.70F, 0.35F, 1.0F) : ImVec4(0.70F, 0.35F, 0.0F, 1.0F);
}

void wrapped_tooltip(const std::string& text) {
  const float em = ImGui::GetFontSize();
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(std::min(30.0F * em, ImGui::GetIO().DisplaySize.x - 2.0F * em));
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

ImVec4 alarm_colour(bool dark) {
  return dark ? ImVec4(0.95F, 0.30F, 0.25F, 1.0F) : ImVec4(0.75F, 0.12F, 0.06F, 1.0F);
}

void apply_theme(bool dark, float scale) {
  ImGuiStyle style;
  if (dark)
    ImGui::StyleColorsDark(&style);
  else
    ImGui::StyleColorsLight(&style);
  style.WindowRounding = 6.0F;
  style.FrameRounding = 4.0F;
  style.FrameBorderSize = dark ? 0.0F : 1.0F;  // white on white in menus
  style.GrabRounding = 4.0F;
  style.WindowBorderSize = dark ? 0.0F : 1.0F;
  style.Colors[ImGuiCol_WindowBg].w = 0.97F;
  style.Colors[ImGuiCol_PopupBg].w = 1.0F;
  // Units stand in this ink: ImGui's own is too pale to read.
  style.Colors[ImGuiCol_TextDisabled] =
      dark ? ImVec4(0.66F, 0.68F, 0.70F, 1.0F) : ImVec4(0.36F, 0.37F, 0.39F, 1.0F);
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
}

}  // namespace fuai
