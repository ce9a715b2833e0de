// Magic with the format's number, size and hash of the rest, owner, state.
#include "experiments/workbench/session/checkpoint.h"

#include "sim/base/archive.h"
#include "sim/base/atomic_file.h"
#include "sim/base/fnv1a.h"
#include "sim/base/whole_file.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr std::string_view kMagic = "hysteron checkpoint ", kFormat = "1\n";
constexpr std::size_t kMax = std::size_t{1} << 40;
constexpr const char* kAnew = "; without --resume the run begins anew";

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
  throw Error::invalid_input("cannot resume from " + file.string() + ": " + why + kAnew)
      .with_key("resume", file.string());
}

void serialise(Archive& archive, CheckpointOwner& owner) {
  for (std::string* text : {&owner.program, &owner.experiment, &owner.device}) archive(*text);
  for (nlohmann::ordered_json* keys : {&owner.scene, &owner.resolved}) {
    std::string text = keys->dump();
    archive(text);
    *keys = nlohmann::ordered_json::parse(text, nullptr, false);
  }
  archive(owner.cloth);
}

struct Seal {
  std::uint64_t size = 0, hash = 0;
};

Seal content_seal(std::string_view body) { return {body.size(), fnv1a(body.data(), body.size())}; }

// What stands behind magic and seal.
std::string_view checked_body(const fs::path& file, std::string_view all) {
  if (all.substr(0, kMagic.size()) != kMagic.substr(0, all.size())) refuse(file, "it is no checkpoint");
  const std::size_t head = kMagic.size() + kFormat.size();
  if (all.size() < head) refuse(file, "it is cut off");
  const std::string_view format = all.substr(kMagic.size(), kFormat.size());
  if (format != kFormat) refuse(file, "it has the format of another version of hysteron");
  if (all.size() < head + sizeof(Seal)) refuse(file, "it is cut off");
  Seal seal;
  Archive(all.substr(head, sizeof seal))(seal);
  const std::string_view body = all.substr(head + sizeof seal);
  if (body.size() < seal.size) refuse(file, "it is cut off");
  if (body.size() > seal.size || content_seal(body).hash != seal.hash) refuse(file, "it is damaged");
  return body;
}

// Its seal holds by chance, or somebody has made it.
CheckpointOwner owner_in(Archive& archive, const fs::path& file) {
  CheckpointOwner owner;
  try {
    serialise(archive, owner);
  } catch (const Error&) {
    refuse(file, "it is damaged");
  }
  if (!owner.scene.is_object() || !owner.resolved.is_object()) refuse(file, "it is damaged");
  return owner;
}

void throw_if_another(const fs::path& file, const CheckpointOwner& there, const CheckpointOwner& here) {
  const auto compare = [&](const char* what, const std::string& a, const std::string& b) {
    if (a != b) refuse(file, "its " + std::string(what) + " is " + a + ", not " + b);
  };
  compare("program", there.program, here.program);
  compare("experiment", there.experiment, here.experiment);
  std::string keys = differing_keys(there.scene, here.scene);
  const std::string resolved = differing_keys(there.resolved, here.resolved);
  if (!keys.empty() && !resolved.empty()) keys += ", ";
  keys += resolved;
  if (!keys.empty()) refuse(file, "other values of " + keys);
  compare("device", there.device, here.device);
  if (there.cloth != here.cloth) refuse(file, "its cloth has another mesh");
}

}  // namespace

std::string differing_keys(const nlohmann::ordered_json& keys, const nlohmann::ordered_json& others) {
  constexpr int kShown = 6;
  const auto a = keys.flatten(), b = others.flatten();
  std::string names;
  int count = 0;
  const auto add = [&](const std::string& pointer) {
    if (pointer.empty()) return;  // an empty object becomes one entry without a name
    if (++count > kShown) return;
    std::string path = pointer.substr(1);
    for (char& c : path)
      if (c == '/') c = '.';
    names += (names.empty() ? "" : ", ") + path;
  };
  for (const auto& [key, value] : a.items())
    if (!b.contains(key) || b[key] != value) add(key);
  for (const auto& [key, value] : b.items())
    if (!a.contains(key)) add(key);
  if (count > kShown) names += " and " + std::to_string(count - kShown) + " more";
  return names;
}

void write_checkpoint(const fs::path& file, CheckpointOwner owner, const std::string& state) {
  Archive archive;
  serialise(archive, owner);
  const std::string body = archive.take() + state;
  const Seal seal = content_seal(body);
  AtomicFile target(file.string());
  target.stream() << kMagic << kFormat;
  target.stream().write(reinterpret_cast<const char*>(&seal), sizeof seal);
  target.stream() << body;
  target.commit();
}

std::optional<std::string> read_checkpoint(const fs::path& file, const CheckpointOwner& owner) {
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(file, ignored))) return {};
  const std::string all = whole_file(file, "cannot resume from " + file.string(), kMax);
  const std::string_view body = checked_body(file, all);
  Archive archive(body);
  throw_if_another(file, owner_in(archive, file), owner);
  return std::string(archive.remainder());
}

}  // namespace hysteron::experiments
