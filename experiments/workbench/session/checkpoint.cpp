// The file consists of magic with the format's number, size and hash of the rest, owner, and state.
#include "experiments/workbench/session/checkpoint.h"

#include "sim/base/archive.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"
#include "sim/base/fnv1a.h"
#include "sim/base/whole_file.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr std::string_view kMagic = "hysteron checkpoint ", kFormat = "3\n";
constexpr std::size_t kMax = std::size_t{1} << 40;
constexpr const char* kAnew = "; without --resume the run begins anew";

struct Seal {
  std::uint64_t size = 0, hash = 0;
};

Seal content_seal(std::string_view body) { return {body.size(), fnv1a(body.data(), body.size())}; }

// Returns the contents behind magic and seal.
std::string_view checked_body(const fs::path& file, std::string_view all) {
  if (all.substr(0, kMagic.size()) != kMagic.substr(0, all.size()))
    refuse_checkpoint(file, "it is no checkpoint");
  const std::size_t head = kMagic.size() + kFormat.size();
  if (all.size() < head) refuse_checkpoint(file, "it is cut off");
  const std::string_view format = all.substr(kMagic.size(), kFormat.size());
  if (format != kFormat) refuse_checkpoint(file, "it has the format of another version of hysteron");
  if (all.size() < head + sizeof(Seal)) refuse_checkpoint(file, "it is cut off");
  Seal seal;
  Archive(all.substr(head, sizeof seal))(seal);
  const std::string_view body = all.substr(head + sizeof seal);
  if (body.size() < seal.size) refuse_checkpoint(file, "it is cut off");
  if (body.size() > seal.size || content_seal(body).hash != seal.hash)
    refuse_checkpoint(file, "it is damaged");
  return body;
}

}  // namespace

void refuse_checkpoint(const fs::path& file, const std::string& why) {
  throw Error::invalid_input("cannot resume from " + file.string() + ": " + why + kAnew)
      .with_key("resume", file.string());
}

void write_checkpoint(const fs::path& file, CheckpointOwner owner, const std::string& state) {
  Archive archive;
  archive(owner.device);
  archive(owner.cloth);
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
  CheckpointOwner there;
  try {
    archive(there.device);
    archive(there.cloth);
  } catch (const Error&) {  // the seal matches by chance, or somebody has made the file
    refuse_checkpoint(file, "it is damaged");
  }
  if (there.device != owner.device)
    refuse_checkpoint(file, "its device is " + there.device + ", not " + owner.device);
  if (there.cloth != owner.cloth) refuse_checkpoint(file, "its cloth has another mesh");
  return std::string(archive.remainder());
}

}  // namespace hysteron::experiments
