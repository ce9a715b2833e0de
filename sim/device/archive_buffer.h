// Saves and loads a device's arrays in an Archive.
#pragma once

#include "sim/base/archive.h"
#include "sim/device/device.h"

namespace hysteron {

// Saves or loads `count` elements at `data`, which has room for them.
template <class T, class Device>
void serialise(Archive& archive, Device& device, T* data, std::size_t count) {
  if (count == 0) return;
  std::string copy(count * sizeof(T), '\0');
  if (!archive.loads()) device_download(device, copy.data(), data, copy.size());
  archive.bytes(copy.data(), copy.size());
  if (archive.loads()) device_upload(device, data, copy.data(), copy.size());
}

// Saves or loads a whole buffer.  If its size differs, as for an array that is made when first needed, it is
// made anew.
template <class T, class Device>
void serialise(Archive& archive, Device& device, Buffer<T, Device>& buffer) {
  const std::size_t size = archive.size(buffer.size());
  if (size != buffer.size()) buffer = Buffer<T, Device>(device, size);
  serialise(archive, device, buffer.data(), size);
}

// Visits several buffers, one after the other.
template <class Device, class... T>
requires(sizeof...(T) > 1) void serialise(Archive& archive, Device& device, Buffer<T, Device>&... buffers) {
  (serialise(archive, device, buffers), ...);
}

}  // namespace hysteron
