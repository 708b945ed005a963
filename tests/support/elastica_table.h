// Exact shapes of clamped strips, by Runge-Kutta shooting to six digits and more.
// SPDX-License-Identifier: Apache-2.0
// Clamped level, L the free length, B the rigidity a width; w the weight an area, P a load at the tip a
// width.
#pragma once

namespace fuai_test {

/// Under its own weight, load = w L^3 / B; lengths over L, angles below level.
struct HeavyRow {
  double load, tip_deg, reach, droop, chord_deg;
  double root;    ///< curvature at the clamp times L
  double peirce;  ///< B by Peirce's formula over B
};
inline constexpr HeavyRow kHeavyRows[] = {
    {0.5, 4.763376, .99777900, .06230577, 3.57316, .2496112, 1.0004},
    {1, 9.460425, .99124640, .12347140, 7.10029, .4969334, 1.0016},
    {2, 18.425967, .96689295, .23850658, 13.85670, .9767427, 1.0061},
    {4, 33.723859, .89011075, .42515928, 25.53136, 1.8442544, 1.0209},
    {5, 39.935432, .84665718, .49590504, 30.35841, 2.2268926, 1.0298},
    {8, 53.864996, .72442473, .64063072, 41.48730, 3.2015764, 1.0575},
    {10, 60.312008, .65635376, .70019972, 46.85125, 3.7421911, 1.0751},
    {20, 76.747785, .44523205, .82988144, 61.78641, 5.7615326, 1.1510},
    {40, 85.902529, .28351886, .89464339, 72.41622, 8.4599924, 1.2785},
    {64, 88.602092, .20920134, .92011284, 77.19071, 10.8523935, 1.4216},
    {100, 89.616748, .15922338, .93752394, 80.36120, 13.6932387, 1.6219}};

/// Under a load at the tip alone, load = P L^2 / B; lengths over L.
struct PointRow {
  double load, reach, droop;
};
inline constexpr PointRow kPointRows[] = {{.25, .99588218, .08274592}, {.5, .98408104, .16214358},
                                          {1, .94356676, .30172077},   {2, .83935828, .49345748},
                                          {3, .74557982, .60325344},   {5, .61237164, .71379152},
                                          {10, .44500440, .81060902}};

}  // namespace fuai_test
