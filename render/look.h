// A look is how things are shown: colours, light and what the cloth's surface carries.  It is not physics:
// the same state may be pictured in any look.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/color_map.h"
#include "render/image.h"

namespace hysteron::render {

enum class Show {
  cloth,       // woven surface
  curvature,   // a signed value per vertex, diverging colours
  friction,    // an amount per vertex, sequential colours
  wireframe,   // the mesh drawn over the cloth
  silhouette,  // cloth black on white and nothing else, as a drape meter's shadow
};

enum class Background {
  studio,       // a pale backdrop that ends in the white page; a figure's is white at once
  white,        // white paper
  transparent,  // no backdrop: the picture is RGBA, with the ground's shadow as alpha
};
constexpr std::array<const char*, 3> names(Background) { return {"studio", "white", "transparent"}; }

enum class Weave {
  plain,  // every thread over one, under one
  twill,  // warp over three, under one, a thread further each time: diagonal lines
  satin,  // warp over four, under one
  knit,   // wales of loops along the warp
};
constexpr std::array<const char*, 4> names(Weave) { return {"plain", "twill", "satin", "knit"}; }

// Returns true if the cloth is drawn as thick as it is.  A drape meter's shadow and a mesh's lines are those
// of its middle.
constexpr bool has_thickness(Show show) { return show != Show::silhouette && show != Show::wireframe; }

struct Look {
  Show show = Show::cloth;
  Background background = Background::studio;  // a silhouette is always on white
  Rgb8 front{104, 132, 166};                   // cloth, side whose triangles are counter-clockwise
  Rgb8 back{168, 173, 178};                    // cloth, other side
  Rgb8 obstacle{196, 190, 182};                // colour of matte obstacles
  Rgb8 backdrop_top{222, 223, 226};            // paper behind and below the scene
  Rgb8 backdrop_bottom{246, 246, 245};
  ColorMap map = ColorMap::diverging;
  float value_low = -1, value_high = 1;  // ends of the colour map, in the value's unit
  // Direction to the key light, any length; none: from the left of the picture (key_direction()).
  std::optional<Eigen::Vector3f> to_light;
  bool raking = false;  // without to_light: the key light almost lies in the cloth's own plane
  float room = 1;       // brightness of the room around; less of it leaves the key light to model the shape
  float thickness = 0.5e-3f;  // thickness of the cloth [m]; it is drawn at least as thick as can be seen
  float sheen = 0.15f;        // sheen of fibres that stand off, 0 = none
  Weave weave_kind = Weave::plain;
  float thread_spacing = 0.45e-3f;  // spacing of warp threads [m]; cotton broadcloth has 20 to 40 per cm
  float weft_spacing = 0;           // spacing of weft threads or a knit's courses [m]; 0: thread_spacing
  float weave = 1;                  // strength of the threads' relief and unevenness, 0 = smooth
  float grid = 0;                   // spacing of a printed grid's lines [m]; 0: none
  // Size at which the picture will be shown over the size that it is drawn at; threads that are too fine to
  // be seen then would make false patterns and are left out.
  float shown = 1;
  // Obstacles are drawn smaller by at least this [m], more below coarse cloth (inset.h).
  float obstacle_inset = 0.8e-3f;
};

// Returns the names of all looks; "grid" is the cloth with a printed grid of 1 cm, "clay" is smooth and grey:
// shape alone.
const std::vector<std::string>& look_names();
// Returns the look of that name with the colour map and colours that suit it; Error::invalid_input for an
// unknown name.
Look look_named(std::string_view name);

}  // namespace hysteron::render
