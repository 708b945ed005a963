// The same lattice as a soft body of the Bullet library, to be timed beside the engine.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace fuai_bench {

/// What the patch is made of. Bullet has no stiffness in units: its links are at their stiffest (kLST 1).
struct BulletClothOptions {
  int side = 64;             ///< nodes a side
  double spacing = 0.01;     ///< [m]
  double areal_mass = 0.15;  ///< [kg/m2]
  int iterations = 1;        ///< of positions, a step
  bool shuffled = false;     ///< links in random order, as Bullet's manual advises for evenness
  bool faces = false;        ///< triangles too, as CreatePatch makes them; only their normals are computed
};

/// A square patch held at two corners: structural links, shear links both ways, bending links over two
/// spacings along both yarns. No collision.
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
  /// Bytes of nodes, links and faces.
  std::size_t bytes() const;
  /// 324 for version 3.24.
  static int version();

 private:
  struct World;
  std::unique_ptr<World> world_;
};

}  // namespace fuai_bench
