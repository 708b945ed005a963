// What the window does with its state between pictures: builds cloths, takes snapshots, opens and saves
// files.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "fuai/picture/cloth_picture.h"
#include "fuai/window/viewer_state.h"

namespace fuai {

/// A setup of fabrics by name or path. @throws Error as load_fabric() and find_scene(). Thread class: set-up.
ViewSetup make_view_setup(const std::string& scene, const std::vector<std::string>& fabrics,
                          const SceneOptions& size);

/// Builds everything that belongs to the document's setup and begins the session. @throws Error. Thread
/// class: the window's.
void begin_session(ViewerState& state);
/// A device takes part, before the user did anything: where it gives forces the session begins anew with
/// cloths that are stepped to be felt. @throws Error. Thread class: the window's.
void meet_device(ViewerState& state, const DeviceInfo& device);
/// The same after a change of the document: what can be kept is. A setup that cannot be built is told and
/// undone. @return whether the cloths are new. Thread class: the window's.
bool follow_document(ViewerState& state);
/// Cloths of the document's setup take over. @param keep, script as ViewSession::replace() @return the number
/// of the build. Thread class: the window's.
std::uint64_t take_cloths(ViewerState& state, std::shared_ptr<ViewCloths> cloths, bool keep,
                          std::shared_ptr<const ViewScript> script = nullptr);
/// New cloths of the same setup, at the start of the scene. @throws Error as ViewCloths. Thread class: the
/// window's.
void restart_cloths(ViewerState& state);
/// Takes what the session has to show. @return whether there is something new. Thread class: the window's.
bool take_snapshot(ViewerState& state);
/// Sees all of the scene. Thread class: the window's.
void frame_view(ViewerState& state);

/// Looks at the vertex nearest to the middle of the first cloth: the middle itself may lie beside it. Thread
/// class: the window's.
void look_at_cloth(ViewerState& state);
/// Lays the picture of a PNG file on the cloths. @param width of the picture on the cloth [m]
/// @return what was wrong, which the window tells too; empty: nothing. Thread class: the window's.
std::string lay_texture(ViewerState& state, const std::string& path, double width);

/// Changes of the document; an error is told and changes nothing. Thread class: the window's.
void add_view_fabric(ViewerState& state, const std::string& source);
void set_view_fabric(ViewerState& state, std::size_t place, const std::string& source);
void remove_view_fabric(ViewerState& state, std::size_t place);
void set_view_scene(ViewerState& state, const std::string& scene);
/// Opens what the user dropped or chose: a recording is done again; a fabric file, or measurements that make
/// one, takes the place of the fabric whose page is shown. Thread class: the window's.
void open_path(ViewerState& state, const std::string& path);

/// What to paint of a cloth. Thread class: the window's.
ClothPicture cloth_picture(const ViewerState& state, std::size_t cloth, int ambient_directions);
/// Range of the heat map over all cloths [SI].
struct HeatRange {
  double low = 0.0, high = 1.0;
};
HeatRange heat_range(const ViewerState& state);

}  // namespace fuai
