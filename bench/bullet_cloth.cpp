// Builds and steps a soft body of Bullet.
// SPDX-License-Identifier: Apache-2.0
#include "bullet_cloth.h"

#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <vector>

#include "fuai/core/constants.h"
#include "fuai/core/hash.h"

namespace fuai_bench {

struct BulletCloth::World {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::unique_ptr<btSoftBody> body;
};

namespace {

/// Calls link(a, b) for every link, row by row.
template <class Link>
void for_links(int n, const Link& link) {
  for (int r = 0; r < n; ++r) {
    for (int c = 0; c < n; ++c) {
      const int i = r * n + c;
      if (c + 1 < n) link(i, i + 1);
      if (r + 1 < n) link(i, i + n);
      if (c + 1 < n && r + 1 < n) {
        link(i, i + n + 1);
        link(i + 1, i + n);
      }
      if (c + 2 < n) link(i, i + 2);
      if (r + 2 < n) link(i, i + 2 * n);
    }
  }
}

btSoftBody* yarn_patch(const BulletClothOptions& options, btSoftBodyWorldInfo& info) {
  const int n = options.side;
  std::vector<btVector3> positions;
  for (int r = 0; r < n; ++r) {
    for (int c = 0; c < n; ++c)
      positions.emplace_back(static_cast<btScalar>(c * options.spacing),
                             static_cast<btScalar>(r * options.spacing), btScalar(0));
  }
  auto* body = new btSoftBody(&info, n * n, positions.data(), nullptr);
  for_links(n, [&](int a, int b) { body->appendLink(a, b); });
  return body;
}

btSoftBody* demo_patch(const BulletClothOptions& options, btSoftBodyWorldInfo& info) {
  const auto length = static_cast<btScalar>((options.side - 1) * options.spacing);
  auto* body = btSoftBodyHelpers::CreatePatch(info, {0, 0, 0}, {length, 0, 0}, {0, length, 0},
                                              {length, length, 0}, options.side, options.side, 0, true);
  body->generateBendingConstraints(2);
  return body;
}

}  // namespace

BulletCloth::BulletCloth(const BulletClothOptions& options)
    : world_(std::make_unique<World>()), reach_(10.0 * options.side * options.spacing) {
  const int n = options.side;
  const btVector3 gravity(0, 0, static_cast<btScalar>(-fuai::kStandardGravity));
  world_->world.setGravity(gravity);
  world_->world.getWorldInfo().m_gravity = gravity;
  const bool demo = options.links != BulletLinks::kYarns;
  world_->body.reset(demo ? demo_patch(options, world_->world.getWorldInfo())
                          : yarn_patch(options, world_->world.getWorldInfo()));
  btSoftBody& body = *world_->body;
  body.m_materials[0]->m_kLST = 1;
  body.m_cfg.piterations = options.iterations;
  body.m_cfg.collisions = 0;
  if (options.links != BulletLinks::kDemo) body.randomizeConstraints();
  for (int i = 0; i < n * n; ++i)
    body.setMass(i, static_cast<btScalar>(options.areal_mass * options.spacing * options.spacing));
  for (int corner : {(n - 1) * n, n * n - 1}) body.setMass(corner, 0);
  world_->world.addSoftBody(&body);
}

BulletCloth::~BulletCloth() { world_->world.removeSoftBody(world_->body.get()); }

// No substeps: dt as it is.
void BulletCloth::step(double dt) { world_->world.stepSimulation(static_cast<btScalar>(dt), 0); }

std::string BulletCloth::position_hash() const {
  fuai::StateHash hash;
  const btSoftBody& body = *world_->body;
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    for (int k = 0; k < 3; ++k) hash.add(static_cast<double>(body.m_nodes[i].m_x[k]));
  }
  return hash.hex();
}

bool BulletCloth::is_whole() const {
  const btSoftBody& body = *world_->body;
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    if (!(static_cast<double>(body.m_nodes[i].m_x.length()) < reach_)) return false;
  }
  return true;
}

std::size_t BulletCloth::bytes() const {
  const btSoftBody& body = *world_->body;
  return static_cast<std::size_t>(body.m_nodes.size()) * sizeof(btSoftBody::Node) +
         static_cast<std::size_t>(body.m_links.size()) * sizeof(btSoftBody::Link) +
         static_cast<std::size_t>(body.m_faces.size()) * sizeof(btSoftBody::Face);
}

int BulletCloth::version() { return btGetVersion(); }

}  // namespace fuai_bench
