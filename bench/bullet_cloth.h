// The same lattice as a soft body of the Bullet library, to be timed beside the engine.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace fuai_bench {

/// Which links a patch has. Six a node in the order of the rows blow up from 64 nodes a side on: not offered.
enum class BulletLinks {
  kYarns,         ///< structural, shear both ways, bending over two spacings along both yarns: 6 a node, in
                  ///< random order (randomizeConstraints)
  kDemo,          ///< as in Bullet's cloth demos: CreatePatch with diagonals and faces, and bending links
                  ///< between all nodes two links apart, 12 a node; memory goes with the nodes squared
  kDemoShuffled,  ///< the same in random order
};

/// What the patch is made of. Bullet has no stiffness in units: its links are at their stiffest (kLST 1).
struct BulletClothOptions {
  int side = 64;             ///< nodes a side
  double spacing = 0.01;     ///< [m]
  double areal_mass = 0.15;  ///< [kg/m2]
  int iterations = 1;        ///< of positions, a step
  BulletLinks links = BulletLinks::kYarns;
};

/// A square patch held at two corners. No collision.
class BulletCloth {
 public:
  /// Thread class: set-up.
  explicit BulletCloth(const BulletClothOptions& options);
  ~BulletCloth();
  BulletCloth(const BulletCloth&) = delete;
  BulletCloth& operator=(const BulletCloth&) = delete;

  /// One step of dt [s].
  void step(double dt);
  /// Hash of all positions.
  std::string position_hash() const;
  /// False when a node is farther off than ten sides of the patch, or nowhere: Bullet then does nothing more.
  bool is_whole() const;
  /// Bytes of nodes, links and faces.
  std::size_t bytes() const;
  /// 324 for version 3.24.
  static int version();

 private:
  struct World;
  std::unique_ptr<World> world_;
  double reach_ = 0.0;  // [m]
};

}  // namespace fuai_bench
