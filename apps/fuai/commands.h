// The commands: their options and what runs them. Each returns the process's exit code.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "console.h"

namespace fuai_app {

int run_fabrics(const Console& console);

struct ImportOptions {
  std::vector<std::string> files;
  std::string output;
  std::string name;       ///< replaces the name found in the files
  std::string mass;       ///< with unit; needed with curve files alone
  std::string thickness;  ///< with unit
  std::string test;       ///< for curve files without a fuai-curve line
  std::string direction;  ///< the same
};
int run_import(const Console& console, const ImportOptions& options);

struct ShowOptions {
  std::string fabric;
  std::string plot;  ///< .png or .svg; empty: none
};
int run_show(const Console& console, const ShowOptions& options);

struct PaperOptions {
  std::string out = "out/paper";
  int figure = 0;  ///< 0: all; 1, 4, 6, 7 or 8
};
int run_paper(const Console& console, const PaperOptions& options);

int run_scenes(const Console& console);

struct RenderOptions {
  std::string scene;
  std::string fabric = "cupro-woven-su1098";
  std::string time;     ///< with unit; empty: the scene's own, of the paper's until it is at rest
  int size = 0;         ///< nodes a side; 0: the scene's own
  std::string spacing;  ///< with unit; empty: the scene's own
  std::string output;
  int width = 1280, height = 800;
  bool as_printed = false;
};
int run_render(const Console& console, const RenderOptions& options);

struct SimulateOptions {
  std::string scene;
  std::string fabric = "cupro-woven-su1098";
  int size = 0;            ///< nodes a side; 0: the scene's own
  std::string spacing;     ///< with unit; empty: the scene's own
  std::string dt = "1ms";  ///< with unit
  std::string seconds;     ///< a number of seconds, or a time with unit; empty: the scene's own
  std::string solver = "implicit";
  int iterations = 0;     ///< 0: the solver's own
  std::string precision;  ///< empty: the solver's own
  std::string record;     ///< CSV file; empty: none
};
int run_simulate(const Console& console, const SimulateOptions& options);

struct KesCommandOptions {
  std::string test;  ///< bending, tensile, shear, buckling or stretch
  std::string fabric;
  std::string direction;             ///< warp or weft; empty: warp, in shear both
  std::string csv, plot;             ///< files; empty: none
  std::vector<std::string> reverse;  ///< "OUT" or "OUT:BACK" in the unit of the test
  std::string spacing;               ///< with unit; empty: the instrument's own
};
int run_kes(const Console& console, const KesCommandOptions& options);

struct CantileverCommandOptions {
  std::string fabric;
  std::string direction = "warp";
  std::string length;         ///< with unit; empty with an angle
  std::string angle;          ///< of the chord, with unit: finds the overhang; empty with a length
  std::string width = "2cm";  ///< with unit
  std::string spacing;        ///< with unit; empty: a fortieth of the length
  bool elastic = false;
};
int run_cantilever(const Console& console, const CantileverCommandOptions& options);

struct DrapeCommandOptions {
  std::string fabric;
  std::string disc = "18cm";      ///< diameter with unit
  std::string specimen = "30cm";  ///< diameter with unit
  std::string spacing = "5mm";    ///< with unit
  int runs = 5;                   ///< specimens
  std::string path = "ramp";      ///< ramp, release, shakes or support
  std::string solver = "implicit";
  std::string loading = "2s";  ///< time with unit, of the ramp or of lowering the support
  std::string linger;          ///< time with unit to go on at rest; empty: none
  std::string out;             ///< folder; empty: no files
  bool elastic = false;        ///< without friction
  bool no_bands = false;       ///< assumptions are not tried
  bool convergence = false;    ///< at other spacings too
};
int run_drape(const Console& console, const DrapeCommandOptions& options);
struct LoopCommandOptions {
  std::string kind;  ///< heart, pear or ring
  std::string fabric;
  std::string direction = "warp";
  std::string length = "10cm";  ///< with unit
  int segments = 80;
  bool elastic = false;
};
int run_loop(const Console& console, const LoopCommandOptions& options);

}  // namespace fuai_app
