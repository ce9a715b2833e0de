#include "experiments/workbench/pictures/fabric_look.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/scene/assets.h"
#include "sim/scene/toml_file.h"

namespace hysteron::experiments {
namespace {

constexpr double kLightening = 0.3;  // shift to white of a back that the file does not define

struct FabricLook {
  Eigen::Vector3d colour{0, 0, 0}, back{0, 0, 0};
  render::Weave weave = render::Weave::plain;
  Numbers threads;
  double sheen = 0;
  std::string source;
};
using L = FabricLook;
const KeyRow<FabricLook> kRows[] = {
    {"look.colour", at<&L::colour>, "", between(0, 255), "of the front, sRGB"},
    {"look.back", at<&L::back>, "", between(0, 255), "of the back, sRGB"},
    {"look.weave", at<&L::weave>, "", any(), "how the threads cross"},
    {"look.threads", at<&L::threads>, "1/cm", between(1, 200), "of warp and weft, or wales and courses"},
    {"look.sheen", at<&L::sheen>, "", between(0, 1), "of fibres that stand off"},
    {"look.source", at<&L::source>, "", any(), "where this comes from"}};

FabricLook read_look(const ValueTree& table, const std::string& file) {
  const auto refuse = [&](const std::string& why) {
    throw Error::invalid_input("look " + why + " (" + place(file, table) + ")");
  };
  FabricLook look;
  const Keys keys = bind(kRows, look);
  for (const ValueTree& node : table.children) assign(keys, node, file, "look.");
  for (const char* key : {"colour", "weave", "threads", "sheen", "source"})
    if (!table.find(key)) refuse(std::string("needs ") + key);
  if (look.threads.size() != 2) refuse("needs two numbers of threads");
  if (!table.find("back"))
    look.back = look.colour + kLightening * (Eigen::Vector3d::Constant(255) - look.colour);
  return look;
}

render::Rgb8 rgb8(const Eigen::Vector3d& color) {
  render::Rgb8 bytes;
  std::transform(color.begin(), color.end(), bytes.begin(),
                 [](double x) { return static_cast<std::uint8_t>(std::lround(x)); });
  return bytes;
}

}  // namespace

render::Look apply_fabric_look(render::Look look, const std::string& fabric) {
  if (look.show != render::Show::cloth || look.weave == 0) return look;
  const std::string file = find_asset("fabrics", fabric, "the look of pictures").string();
  const ValueTree root = read_toml(file);
  const ValueTree* const table = root.find("look");
  if (!table) return look;
  const FabricLook own = read_look(*table, file);
  look.front = rgb8(own.colour);
  look.back = rgb8(own.back);
  look.weave_kind = own.weave;
  look.thread_spacing = static_cast<float>(0.01 / own.threads[0]);
  look.weft_spacing = static_cast<float>(0.01 / own.threads[1]);
  look.sheen = static_cast<float>(own.sheen);
  return look;
}

}  // namespace hysteron::experiments
