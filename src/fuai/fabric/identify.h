// Makes play laws from branches given on equally spaced nodes: both branches come back exactly at every node.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/play-law.md, Eqs. I1 and I2.
#pragma once

#include <span>
#include <vector>

#include "fuai/fabric/play_law.h"

namespace fuai {

/// The two branches of a steady loop between two turning points, on common equally spaced nodes.
struct LoopNodes {
  double low = 0.0, high = 0.0;  ///< turning points [unit of strain]
  std::vector<double> up;        ///< stress while the strain rises, first node at low (nodes)
  std::vector<double> down;      ///< stress while the strain falls (nodes)
};

/// The first loading of virgin cloth from zero and the recovery from its end, on common equally spaced nodes.
struct VirginNodes {
  double high = 0.0;             ///< largest strain [unit of strain]; the first node is zero
  std::vector<double> load;      ///< virgin loading (nodes)
  std::vector<double> recovery;  ///< unloading from `high` (nodes)
};

/// Share of the friction mobilised at distance u from a virgin state: G(u) = sum w_j min(u / r_j, 1).
double mobilised_share(std::span<const PlayElement> elements, double u);

/// The law whose steady loop between low and high has exactly these branches at the nodes, whatever the
/// elements are. Where the data cross (down above up) the friction is zero and both branches become their
/// mean.
/// @param outside how the elastic curve goes on beyond the loop; the friction keeps its end values
/// @throws Error (kBadInput) when an element's radius exceeds half the range, or the nodes are too few or
/// unequal. Thread class: set-up. @source docs/theory/play-law.md, Eqs. I1, I2
PlayLaw identify_loop(const LoopNodes& nodes, std::span<const PlayElement> elements,
                      const Extrapolation& outside);

/// The law whose virgin loading and recovery from `high` are exactly these branches at the nodes.
/// @param mirrored true: the other side behaves alike (odd elastic curve, even friction), as for shear and
/// for a bending
///   test of one face; false: the table begins at zero, as for tension, and `outside` says what compression
///   does
/// Errors and thread class as identify_loop.
PlayLaw identify_virgin(const VirginNodes& nodes, std::span<const PlayElement> elements, bool mirrored,
                        const Extrapolation& outside);

/// Five elements of equal weight whose radii 0.04 : 0.1 : 0.2 : 0.4 : 0.8 are scaled so that the friction
/// strength of the loop varies least (the integral of Y'^2 is smallest): a loop says nothing else about them.
/// Thread class: set-up.
std::vector<PlayElement> smoothest_elements(const LoopNodes& nodes);

/// The same five elements with the largest radius equal to `largest_radius`. Thread class: set-up.
std::vector<PlayElement> scaled_elements(double largest_radius);

}  // namespace fuai
