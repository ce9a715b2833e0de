#include "experiments/workbench/pictures/fabric_look.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/base/comma_list.h"
#include "sim/base/error.h"
#include "sim/scene/assets.h"
#include "sim/scene/toml_file.h"

namespace hysteron::experiments {
namespace {

constexpr double kLightening = 0.3;  // of a back that the file does not name, toward white
const std::vector<std::string> kKeys = {"colour", "back", "weave", "threads", "sheen", "source"};

class Table {
 public:
  Table(const std::string& file, const ValueTree& table) : file_(file), table_(table) {
    for (const ValueTree& node : table.children)
      if (!std::count(kKeys.begin(), kKeys.end(), node.key))
        throw refusal(node, "is unknown; allowed: " + join(kKeys, ", "));
  }

  bool has(const char* key) const { return table_.find(key); }

  std::string text(const char* key) const {
    const auto* words = std::get_if<std::string>(&at(key).value);
    return words ? *words : throw refusal(at(key), "must be a text");
  }

  double number(const char* key, double low, double high) const {
    const ValueTree& node = at(key);
    const auto* integer = std::get_if<std::int64_t>(&node.value);
    const auto* real = std::get_if<double>(&node.value);
    const double x = integer ? static_cast<double>(*integer) : real ? *real : low - 1;
    return x >= low && x <= high ? x : throw refusal(node, "must be a number in " + range(low, high));
  }

  std::vector<double> numbers(const char* key, std::size_t count, double low, double high) const {
    const ValueTree& node = at(key);
    const auto* list = std::get_if<std::vector<double>>(&node.value);
    if (list && list->size() == count &&
        std::all_of(list->begin(), list->end(), [&](double x) { return x >= low && x <= high; }))
      return *list;
    throw refusal(node, "must be " + std::to_string(count) + " numbers in " + range(low, high));
  }

  render::Rgb8 colour(const char* key) const {
    render::Rgb8 color;
    const std::vector<double> channels = numbers(key, 3, 0, 255);
    std::transform(channels.begin(), channels.end(), color.begin(),
                   [](double x) { return static_cast<std::uint8_t>(std::lround(x)); });
    return color;
  }

  Error refusal(const ValueTree& node, const std::string& what) const {
    return Error::invalid_input("look." + node.key + " " + what + " (" + place(file_, node) + ")");
  }
  const ValueTree& at(const char* key) const {
    const ValueTree* node = table_.find(key);
    if (!node)
      throw Error::invalid_input("look needs " + std::string(key) + " (" + place(file_, table_) + ")");
    return *node;
  }

 private:
  static std::string range(double low, double high) {
    return "[" + number_text(low) + ", " + number_text(high) + "]";
  }

  const std::string& file_;
  const ValueTree& table_;
};

render::Rgb8 lighter(render::Rgb8 color) {
  for (std::uint8_t& c : color) c = static_cast<std::uint8_t>(std::lround(c + kLightening * (255 - c)));
  return color;
}

render::Weave fabric_weave(const Table& table) {
  try {
    return render::weave_named(table.text("weave"));
  } catch (const Error& error) {
    throw table.refusal(table.at("weave"), error.what());
  }
}

}  // namespace

render::Look dressed(render::Look look, const std::string& fabric) {
  if (look.show != render::Show::cloth || look.weave == 0) return look;
  const std::string file = find_asset("fabrics", fabric, "the look of pictures").string();
  const ValueTree root = read_toml(file);
  const ValueTree* const node = root.find("look");
  if (!node) return look;
  const Table table(file, *node);
  look.front = table.colour("colour");
  look.back = table.has("back") ? table.colour("back") : lighter(look.front);
  look.weave_kind = fabric_weave(table);
  const std::vector<double> threads = table.numbers("threads", 2, 1, 200);
  look.thread_spacing = static_cast<float>(0.01 / threads[0]);
  look.weft_spacing = static_cast<float>(0.01 / threads[1]);
  look.sheen = static_cast<float>(table.number("sheen", 0, 1));
  table.text("source");
  return look;
}

}  // namespace hysteron::experiments
