// The one table of KES quantities.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/units/kes.h"

#include <algorithm>
#include <array>

#include "fuai/units/constants.h"

namespace fuai {
namespace {

using namespace unit;  // NOLINT(google-build-using-namespace): the table below is nothing but units

// The plausible ranges are orders of magnitude for warnings only; see docs/theory/kes.md.
constexpr std::array kTable = {
    KesQuantity{Kes::kLT, "LT", "LT", "tensile", "-", "-", 1.0, "tensile linearity", "引張り直線性",
                "WT / (Fm EMT / 2): work of loading over that of a straight line to the same end point",
                "WT / (Fm EMT / 2)。同じ終点までの直線に対する引張り仕事量の比", 0.2, 1.3},
    KesQuantity{Kes::kWT, "WT", "WT_gf_cm_per_cm2", "tensile", "gf·cm/cm²", "J/m²", kGfCmPerCm2,
                "tensile work", "引張り仕事量", "integral of F over strain on loading, 0 to Fm",
                "引張り時（0 から Fm まで）の F をひずみで積分した値", 0.3, 80.0},
    KesQuantity{Kes::kRT, "RT", "RT_percent", "tensile", "%", "-", kPercent, "tensile resilience",
                "引張りレジリエンス", "100 WT'/WT, WT' the work given back on recovery to zero force",
                "100 WT'/WT。WT' は力がゼロに戻るまでに返る仕事量", 15.0, 95.0},
    KesQuantity{Kes::kEMT, "EMT", "EMT_percent", "tensile", "%", "-", kPercent, "extensibility",
                "最大荷重時の伸び率",
                "strain at the largest load Fm (500 gf/cm; 50 gf/cm in the knit setting)",
                "最大荷重 Fm（500 gf/cm、ニット用の設定では 50 gf/cm）でのひずみ", 0.5, 90.0},
    KesQuantity{Kes::kG, "G", "G_gf_per_cm_deg", "shear", "gf/(cm·deg)", "N/(m·rad)", kGfPerCmDeg,
                "shear rigidity", "せん断剛性",
                "slope of shear force over angle, 0.5 to 2.5 deg, least squares, mean of both sides",
                "せん断角 0.5～2.5° でのせん断力の傾き（最小二乗、両側の平均）", 0.1, 10.0},
    KesQuantity{Kes::k2HG, "2HG", "2HG_gf_per_cm", "shear", "gf/cm", "N/m", kGfPerCm,
                "shear hysteresis at 0.5 deg", "せん断ヒステリシス (0.5°)",
                "width of the loop at 0.5 deg, mean of both sides",
                "せん断角 0.5° でのループの幅（両側の平均）", 0.02, 20.0},
    KesQuantity{Kes::k2HG5, "2HG5", "2HG5_gf_per_cm", "shear", "gf/cm", "N/m", kGfPerCm,
                "shear hysteresis at 5 deg", "せん断ヒステリシス (5°)",
                "width of the loop at 5 deg, mean of both sides", "せん断角 5° でのループの幅（両側の平均）",
                0.05, 30.0},
    KesQuantity{Kes::kB, "B", "B_gf_cm2_per_cm", "bending", "gf·cm²/cm", "N·m", kGfCm2PerCm,
                "bending rigidity", "曲げ剛性",
                "slope of moment over curvature, 0.5 to 1.5 1/cm, least squares, mean of both faces",
                "曲率 0.5～1.5 1/cm でのモーメントの傾き（最小二乗、表裏の平均）", 0.001, 10.0},
    KesQuantity{Kes::k2HB, "2HB", "2HB_gf_cm_per_cm", "bending", "gf·cm/cm", "N", kGfCmPerCm,
                "bending hysteresis", "曲げヒステリシス", "width of the loop at 1.0 1/cm, mean of both faces",
                "曲率 1.0 1/cm でのループの幅（表裏の平均）", 0.0005, 5.0},
    KesQuantity{Kes::kLC, "LC", "LC", "compression", "-", "-", 1.0, "compression linearity", "圧縮直線性",
                "WC / (Pm (T0 - Tm) / 2)",
                "WC / (Pm (T0 - Tm) / 2)。同じ終点までの直線に対する圧縮仕事量の比", 0.1, 0.9},
    KesQuantity{Kes::kWC, "WC", "WC_gf_cm_per_cm2", "compression", "gf·cm/cm²", "J/m²", kGfCmPerCm2,
                "compression work", "圧縮仕事量", "integral of P over thickness on loading, T0 to Tm",
                "圧縮時（T0 から Tm まで）の P を厚さで積分した値", 0.005, 3.0},
    KesQuantity{Kes::kRC, "RC", "RC_percent", "compression", "%", "-", kPercent, "compression resilience",
                "圧縮レジリエンス", "100 WC'/WC, WC' the work given back",
                "100 WC'/WC。WC' は回復で返る仕事量", 15.0, 95.0},
    KesQuantity{Kes::kMIU, "MIU", "MIU", "surface", "-", "-", 1.0, "mean friction coefficient",
                "平均摩擦係数", "mean of the friction coefficient over the measured 20 mm of a 30 mm stroke",
                "30 mm の移動のうち測定区間 20 mm での摩擦係数の平均", 0.05, 0.6},
    KesQuantity{Kes::kMMD, "MMD", "MMD", "surface", "-", "-", 1.0, "mean deviation of friction",
                "摩擦係数の平均偏差", "mean of |mu - MIU| over the same stroke",
                "同じ区間での |μ - MIU| の平均", 0.001, 0.1},
    KesQuantity{Kes::kSMD, "SMD", "SMD_um", "surface", "um", "m", kMicrometre, "geometrical roughness",
                "表面粗さの平均偏差", "mean of |height - mean height| over the stroke",
                "同じ区間での |高さ - 平均の高さ| の平均", 0.2, 40.0},
    KesQuantity{Kes::kT, "T", "T_mm", "thickness", "mm", "m", kMillimetre, "thickness at 0.5 gf/cm²", "厚さ",
                "distance of the plates at 0.5 gf/cm²", "圧力 0.5 gf/cm² での板の間隔", 0.03, 5.0},
    KesQuantity{Kes::kW, "W", "W_mg_per_cm2", "weight", "mg/cm²", "kg/m²", kMgPerCm2, "areal mass",
                "単位面積重量", "mass per area; 1 mg/cm² is 10 g/m²", "面積あたりの質量。1 mg/cm² は 10 g/m²",
                1.5, 120.0},
    KesQuantity{Kes::kDrapeCoefficient, "DC", "drape_coefficient_percent", "drape", "%", "-", kPercent,
                "drape coefficient", "ドレープ係数",
                "100 (shadow - disc) / (specimen - disc), areas; comparable only at equal diameters",
                "面積で 100 (影 - 円板) / (試料 - 円板)。直径が同じときだけ比べられる", 5.0, 100.0},
};

}  // namespace

std::span<const KesQuantity> kes_quantities() { return kTable; }

const KesQuantity& kes_quantity(Kes id) { return kTable[static_cast<std::size_t>(id)]; }

std::optional<Kes> find_kes(std::string_view key_or_symbol) {
  const auto* found = std::ranges::find_if(
      kTable, [&](const KesQuantity& q) { return q.key == key_or_symbol || q.symbol == key_or_symbol; });
  if (found == kTable.end()) return std::nullopt;
  return found->id;
}

}  // namespace fuai
