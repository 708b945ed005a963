// The local model, the way into the device's coordinates, and the coupling.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

#include "fuai/haptics/coupling_rt.h"
#include "fuai/haptics/local_model_rt.h"
#include "fuai/haptics/workspace_map_rt.h"

using namespace fuai;

namespace {

Mat3 turn(double angle, const Vec3& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

LocalModel sample_model() {
  LocalModel model;
  model.number = 3;
  model.time = 2.0;
  model.grasped = true;
  model.origin = Vec3(0.1, -0.2, 0.3);
  model.origin_velocity = Vec3(0.05, 0.02, -0.04);
  model.force = Vec3(0.4, -0.6, 0.2);
  model.force_rate = Vec3(3.0, 1.0, -2.0);
  const Mat3 R = turn(0.7, Vec3(1, 2, -1));
  model.stiffness = R * Vec3(1500.0, 300.0, 20.0).asDiagonal() * R.transpose();
  model.damping = 0.3 * Mat3::Identity();
  model.trust_radius = 0.01;
  model.horizon = 0.03;
  model.stored_energy = 0.02;
  return model;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("force at the origin, along the expected way, beside it, and beyond horizon and trust") {
    const LocalModel model = sample_model();
    CHECK((model_force(model, model.origin, model.origin_velocity, 2.0) - model.force).norm() < 1e-12);
    const Vec3 ahead = expected_position(model, 2.02);
    CHECK((ahead - model.origin - 0.02 * model.origin_velocity).norm() < 1e-15);
    CHECK((model_force(model, ahead, model.origin_velocity, 2.02) - model.force - 0.02 * model.force_rate)
              .norm() < 1e-12);
    // Beyond the horizon and before the beginning nothing goes on.
    CHECK((expected_position(model, 2.5) - expected_position(model, 2.03)).norm() < 1e-15);
    CHECK(expected_position(model, 1.0) == model.origin);
    const Vec3 far = Vec3(0.0, 0.05, 0.0), edge = Vec3(0.0, 0.01, 0.0);
    CHECK(!is_trusted(model, model.origin + far, 2.0));
    CHECK(is_trusted(model, model.origin + 0.999 * edge, 2.0));
    CHECK((model_force(model, model.origin + far, model.origin_velocity, 2.0) -
           model_force(model, model.origin + edge, model.origin_velocity, 2.0))
              .norm() < 1e-12);
  }

  TEST_CASE("what is no number is found in every field that is computed with") {
    CHECK(is_finite(sample_model()));
    for (int field = 0; field < 9; ++field) {
      LocalModel model = sample_model();
      if (field == 0) model.time = NAN;
      if (field == 1) model.origin.x() = INFINITY;
      if (field == 2) model.origin_velocity.y() = NAN;
      if (field == 3) model.force.z() = NAN;
      if (field == 4) model.force_rate.x() = -INFINITY;
      if (field == 5) model.stiffness(2, 1) = NAN;
      if (field == 6) model.damping(0, 2) = NAN;
      if (field == 7) model.trust_radius = NAN;
      if (field == 8) model.ledger.work = NAN;
      CAPTURE(field);
      CHECK(!is_finite(model));
    }
  }

  TEST_CASE("a passive matrix is symmetric, its eigenvalues lie between zero and the most, others stay") {
    const Mat3 R = turn(1.1, Vec3(3, -1, 2));
    Mat3 rough = R * Vec3(-40.0, 90.0, 5000.0).asDiagonal() * R.transpose();
    rough(0, 1) += 7.0;
    rough(1, 0) -= 7.0;
    const Mat3 passive = make_passive(rough, 2000.0);
    const Mat3 expected = R * Vec3(0.0, 90.0, 2000.0).asDiagonal() * R.transpose();
    CHECK((passive - expected).norm() < 1e-9 * 2000.0);
    CHECK((make_passive(passive, 2000.0) - passive).norm() < 1e-9 * 2000.0);
    rough(1, 1) = NAN;
    CHECK(make_passive(rough, 2000.0) == Mat3::Zero());
  }
}

TEST_SUITE("analytic") {
  TEST_CASE("the map and its inverse; forces by the gain; work by gain over scale") {
    WorkspaceMap map;
    map.scale = 2.5;
    map.force_gain = 4.0;
    map.rotation = turn(0.4, Vec3(1, 1, 0));
    map.device_centre = Vec3(0.01, 0.02, -0.03);
    map.cloth_centre = Vec3(0.5, -0.1, 0.2);
    const Vec3 device(0.03, -0.05, 0.07), velocity(0.2, 0.1, -0.3);
    CHECK((map.to_device(map.to_tool(device)) - device).norm() < 1e-15);
    const LocalModel model = sample_model(), felt = map.to_device(model);
    const double t = 2.015;
    const Vec3 cloth_force = model_force(model, map.to_tool(device), map.way_to_tool(velocity), t);
    const Vec3 device_force = model_force(felt, device, velocity, t);
    // Inside the trust radius both are the same straight line; beyond, too, as the radius is scaled.
    CHECK((device_force - map.force_gain * map.rotation.transpose() * cloth_force).norm() < 1e-11);
    CHECK(device_force.dot(velocity) ==
          doctest::Approx(map.force_gain / map.scale * cloth_force.dot(map.way_to_tool(velocity))));
    CHECK(felt.stored_energy == doctest::Approx(map.force_gain / map.scale * model.stored_energy));
  }

  TEST_CASE("a clutch: the device goes elsewhere, the tool stays") {
    WorkspaceMap map;
    map.scale = 1.7;
    map.rotation = turn(-0.8, Vec3(0, 1, 3));
    const Vec3 tool = map.to_tool(Vec3(0.05, 0.01, 0.0)), elsewhere(-0.04, 0.03, 0.02);
    map.close_clutch(tool, elsewhere);
    CHECK((map.to_tool(elsewhere) - tool).norm() < 1e-15);
  }

  TEST_CASE("coupling: springs in series, tool where both pull alike, force and energy those of the pair") {
    LocalModel model = sample_model();
    model.damping = Mat3::Zero();
    model.trust_radius = INFINITY;
    const double most = 800.0;
    const CoupledModel coupled = couple(model, most);
    CHECK(coupled.compliance == doctest::Approx(1.0 / most - 1.0 / 1500.0).epsilon(1e-9));
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(coupled.model.stiffness);
    CHECK(eigen.eigenvalues()[2] == doctest::Approx(most).epsilon(1e-9));
    CHECK(eigen.eigenvalues()[1] == doctest::Approx(1.0 / (coupled.compliance + 1.0 / 300.0)).epsilon(1e-9));
    const Vec3 device(0.102, -0.199, 0.304), still = model.origin_velocity;
    const Vec3 felt = model_force(coupled.model, device, still, 2.0);
    const Vec3 tool = device + coupled.compliance * felt;
    CHECK((model_force(model, tool, still, 2.0) - felt).norm() < 1e-9);
    // The coupled spring stores what the pair stores, its own part included.
    CHECK(coupled.model.stored_energy ==
          doctest::Approx(model.stored_energy + 0.5 * coupled.compliance * model.force.squaredNorm()));
    // A soft model is left alone, bit for bit.
    const CoupledModel soft = couple(model, 2000.0);
    CHECK(soft.compliance == 0.0);
    CHECK(soft.model.stiffness == model.stiffness);
    CHECK(soft.model.origin == model.origin);
  }
}
