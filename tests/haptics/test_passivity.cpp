// The books of a port and the brake.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "fuai/haptics/passivity_rt.h"
#include "fuai/haptics/virtual_session.h"
#include "wide_open.h"

using namespace fuai;
using namespace fuai_test;

TEST_SUITE("analytic") {
  TEST_CASE("a spring by sample and hold leaks K dx^2 / 2 a tick, whichever way it goes") {
    for (double way : {1.0, -1.0}) {
      constexpr double kStiffness = 300.0, kWay = 1e-4;
      Passivity books;
      books.move(Vec3::Zero());
      books.expect(Vec3::Zero());
      books.give(Vec3::Zero());
      for (int i = 1; i <= 100; ++i) {
        const Vec3 x(way * i * kWay, 0.0, 0.0), force = -kStiffness * x;
        books.move(x);
        books.expect(force);
        books.give(force);
      }
      CHECK(books.ledger().leak == doctest::Approx(-100 * 0.5 * kStiffness * kWay * kWay).epsilon(1e-9));
      // The hand put in the spring's energy less the leak.
      CHECK(books.ledger().work ==
            doctest::Approx(0.5 * kStiffness * 1e-4 - 100 * 0.5 * kStiffness * kWay * kWay).epsilon(1e-9));
    }
  }

  TEST_CASE("an audit counts what was put in and is not stored, up to the reserve, and forgives the start") {
    PassivityOptions options;
    options.reserve = 0.5e-3;
    Passivity books(options);
    LocalModel model;
    model.stored_energy = 7.0;  // what the cloth had before
    books.audit(model, 1.0);
    CHECK(books.energy() == 0.0);
    model.ledger.work = 3e-3;
    model.stored_energy = 7.0 + 2.8e-3;  // 0.2 mJ were lost
    books.audit(model, 1.0);
    CHECK(books.energy() == doctest::Approx(0.2e-3));
    model.ledger.work += 5e-3;
    books.audit(model, 1.0);
    CHECK(books.energy() == doctest::Approx(options.reserve));
    model.ledger.work -= 2e-3;  // the hand got 2 mJ and the cloth has as much as before
    books.audit(model, 1.0);
    CHECK(books.energy() == doctest::Approx(options.reserve - 2e-3));
    // A model that does not tell changes nothing.
    model.stored_energy = NAN;
    model.ledger.work += 1.0;
    books.audit(model, 1.0);
    CHECK(books.energy() == doctest::Approx(options.reserve - 2e-3));
    books.restart();
    CHECK(books.energy() == 0.0);
  }

  TEST_CASE("the brake opposes the motion, pays within the time asked for, and is bounded") {
    PassivityOptions options;
    Passivity books(options);
    LocalModel model;
    model.stored_energy = 0.0;
    books.audit(model, 1.0);
    model.ledger.work = -0.3e-3;
    books.audit(model, 1.0);
    const Vec3 v(0.1, 0.0, -0.2);
    const Vec3 brake = books.brake(v, kTick);
    CHECK(brake.cross(v).norm() < 1e-15);
    CHECK(-brake.dot(v) * options.payback == doctest::Approx(0.3e-3 - options.tolerance));
    // Slow motion: the bound, less than half of the dead stop m / dt.
    const Vec3 slow = 1e-3 * v;
    CHECK(books.brake(slow, kTick).norm() == doctest::Approx(0.45 * options.mass / kTick * slow.norm()));
    CHECK(books.brake(Vec3::Zero(), kTick) == Vec3::Zero());
    options.control = false;
    CHECK(Passivity(options).brake(v, kTick) == Vec3::Zero());
  }
}

TEST_SUITE("property") {
  TEST_CASE("a spring held at 60 Hz makes joules without the controller, and comes to rest with it") {
    for (double stiffness : {20.0, 40.0, 60.0}) {
      double lost[2];
      for (bool control : {false, true}) {
        SimulatedDevice device = still_device(bare_device(0.1));
        ForcePathOptions options = wide_open();
        options.passivity.control = control;
        ForcePath path(options);
        SpringWall wall(stiffness, 0.0, Vec3::Zero(), SpringWall::Answer::kHeld);
        VirtualSession session(device, path, wall, {1.0 / 60.0, 0.0, 0});
        device.place(Vec3(0.005, 0.0, 0.0));
        const double stored = 0.5 * stiffness * 0.005 * 0.005;
        double& least = lost[control ? 1 : 0];
        least = 0.0;
        for (int i = 0; i < 2000; ++i) {
          const double work = device.work_received();
          const double now = 0.5 * stiffness * device.true_position().squaredNorm();
          least = std::min(least, work + stored - now);
          session.tick(kTick);
        }
        if (control) CHECK(device.true_position().norm() < 0.005);
      }
      MESSAGE(stiffness << " N/m: " << 1e3 * lost[0] << " mJ without, " << 1e3 * lost[1] << " mJ with");
      CHECK(lost[0] < -5e-3);
      CHECK(lost[1] > -1e-3);  // the figure
    }
  }
}
