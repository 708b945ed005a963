// What a picture of cloth shows: cloths, obstacles, arrows, ground, camera, colour bar and caption.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fuai/cloth/surface_mesh.h"
#include "fuai/core/types.h"
#include "fuai/picture/colour_map.h"
#include "fuai/picture/image.h"

namespace fuai {

/// The yarns themselves, as light and shade on the surface at their true size. They fade out where a pixel is
/// about as large as a yarn, and they never change the mean light.
struct YarnItem {
  WeaveStructure structure = WeaveStructure::kPlain;
  double warp_pitch = 0.0;  ///< distance of warp yarns, of a knit of its wales [m]; 0: no yarns
  double weft_pitch = 0.0;  ///< distance of weft yarns, of a knit of its courses [m]
};

/// One piece of cloth. Lines of the weave are drawn from the material coordinates: warp lines run along the
/// warp in the colour of warp, weft lines along the weft in the colour of weft.
struct ClothItem {
  SurfaceMesh mesh{};  ///< its `values` are shown in colour when the picture has a colour bar; NaN is grey
  Colour face_colour{0.93, 0.89, 0.82, 1.0};  ///< side from which the triangles run counter-clockwise
  Colour back_colour{0.70, 0.74, 0.79, 1.0};  ///< the other side
  double thread_spacing = 0.01;               ///< distance of the lines of the weave [m]; 0: no lines
  YarnItem yarns{};                           ///< not where values are shown in colour
  std::shared_ptr<const Image> texture{};     ///< on both sides, over their colours; repeated; may be empty
  double texture_width = 0.1;                 ///< what the width of that picture is on the cloth [m]
};

/// A block with sides along the axes, e.g. a table.
struct BoxItem {
  Vec3 low = Vec3::Zero();   ///< [m]
  Vec3 high = Vec3::Zero();  ///< [m]
  Colour colour{0.77, 0.73, 0.68, 1.0};
};

/// An upright cylinder, e.g. the disc of a drape tester.
struct CylinderItem {
  Vec3 top = Vec3::Zero();  ///< centre of its upper face [m]
  double radius = 0.0;      ///< [m]
  double height = 0.0;      ///< [m]
  Colour colour{0.77, 0.73, 0.68, 1.0};
};

/// An arrow, e.g. a force: the caller chooses how many metres stand for a newton.
struct ArrowItem {
  Vec3 origin = Vec3::Zero();  ///< [m]
  Vec3 vector = Vec3::Zero();  ///< from origin to tip [m]; a zero vector is not drawn
  Colour colour{0.80, 0.10, 0.25, 1.0};
  std::string label{};  ///< written at the tip, with its unit; may be empty
  double radius = 0.0;  ///< of the shaft [m]; 0: chosen from the size of the scene
};

/// A horizontal floor with a square grid; it receives shadows and fades out at its rim.
struct GroundItem {
  bool shown = true;
  double height = 0.0;  ///< z [m]
  double size = 0.0;    ///< diameter [m]; 0: three times the size of what stands on it
  double grid = 0.05;   ///< distance of the grid lines [m]; 0: no grid
  Colour colour{0.90, 0.91, 0.92, 1.0};
};

/// Where the picture is seen from.
struct Camera {
  Vec3 eye = Vec3(0.6, -0.8, 0.6);  ///< [m]
  Vec3 target = Vec3::Zero();       ///< point in the middle of the picture [m]
  Vec3 up = Vec3::UnitZ();          ///< direction that points upward in the picture
  double field_of_view = 0.5;       ///< vertical opening angle [rad]
  double parallel_height = 0.0;     ///< 0: perspective; > 0: parallel projection, height of the picture [m]
  double shift_right = 0.0;         ///< moves the content to the right by this fraction of half the width
};

/// Legend of the values of the cloths.
struct ColourBar {
  std::string title{};  ///< what is shown, with its unit, e.g. "moment [gf cm/cm]"
  double low = 0.0;     ///< value at the lower end
  double high = 1.0;    ///< value at the upper end
  ColourMap map = ColourMap::kSequential;
};

/// Small arrows in the corner: the mean directions of warp and weft of the first cloth, and up.
struct TriadItem {
  bool shown = true;
  std::string warp_label = "warp";
  std::string weft_label = "weft";
  std::string up_label = "up";
};

struct ClothPicture {
  std::vector<ClothItem> cloths{};
  std::vector<BoxItem> boxes{};
  std::vector<CylinderItem> cylinders{};
  std::vector<ArrowItem> arrows{};
  GroundItem ground;
  Camera camera;
  std::optional<ColourBar> colour_bar{};
  TriadItem triad;
  std::string caption{};                  ///< UTF-8, upper left, wrapped to the width; "\n" starts a line
  Colour background{1.0, 1.0, 1.0, 1.0};  ///< alpha 0: transparent
  int ambient_directions = 64;            ///< directions of the soft light, 8 to 64; fewer is faster
};

/// A box with sides along the axes; empty while low > high.
struct Bounds {
  Vec3 low = Vec3::Constant(1e300);    ///< [m]
  Vec3 high = Vec3::Constant(-1e300);  ///< [m]

  bool empty() const { return low.x() > high.x(); }
  Vec3 centre() const { return 0.5 * (low + high); }
  void include(const Vec3& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
};

/// Box around cloths, boxes, cylinders and, if asked, arrows; the ground is left out. Thread class: any.
Bounds bounds_of(const ClothPicture& picture, bool with_arrows = true);

/// Fraction of the width that a colour bar takes; hand it to frame_camera to keep the scene clear of it.
inline constexpr double kColourBarStrip = 0.17;

/// A perspective camera that sees the whole of `bounds` with a margin. Thread class: any.
/// @param bounds what to show, not empty
/// @param azimuth where the camera stands around z [rad]: 0 on the +x side, pi/2 on the +y side
/// @param elevation its height above the horizon [rad], in (-pi/2, pi/2]
/// @param aspect width over height of the picture
/// @param right_strip fraction of the width to keep free at the right, e.g. kColourBarStrip
Camera frame_camera(const Bounds& bounds, double azimuth, double elevation, double aspect = 4.0 / 3.0,
                    double right_strip = 0.0);

/// The pixel at which a camera shows a point (column, row; fractions inside a pixel), and its depth along the
/// view [m] in front of the eye. Thread class: any.
/// @param point [m]
Vec3 project_to_pixel(const Camera& camera, int width, int height, const Vec3& point);

/// The camera's right, up and backward directions (unit columns). Thread class: any.
Mat3 camera_axes(const Camera& camera);

}  // namespace fuai
