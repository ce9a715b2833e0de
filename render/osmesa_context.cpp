#include "render/contexts.h"

#include <array>

namespace hysteron::render {
namespace {

// These are declared here because the header comes with libosmesa6-dev, which would also put libOSMesa on the
// linker's path. Values are from Mesa's GL/osmesa.h.
struct OSMesaContextRecord;
constexpr int kFormat = 0x22;
constexpr int kProfile = 0x33;
constexpr int kCoreProfile = 0x34;
constexpr int kMajorVersion = 0x36;
constexpr int kMinorVersion = 0x37;

struct OSMesa {
  OSMesaContextRecord* (*CreateContextAttribs)(const int* attributes, OSMesaContextRecord* shared);
  void (*DestroyContext)(OSMesaContextRecord* context);
  GLboolean (*MakeCurrent)(OSMesaContextRecord* context, void* buffer, GLenum type, GLsizei width,
                           GLsizei height);
  void (*(*GetProcAddress)(const char* name))();

  OSMesa() {
    const SharedLibrary library({"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"});
    library.load("OSMesaCreateContextAttribs", CreateContextAttribs);
    library.load("OSMesaDestroyContext", DestroyContext);
    library.load("OSMesaMakeCurrent", MakeCurrent);
    library.load("OSMesaGetProcAddress", GetProcAddress);
  }
};

const OSMesa& osmesa() {
  static const OSMesa table;
  return table;
}

class OSMesaContext : public Offscreen {
 public:
  explicit OSMesaContext(const Candidate& candidate) : Offscreen(candidate) {
    const int attributes[] = {kFormat,       GL_RGBA, kProfile, kCoreProfile, kMajorVersion, 3,
                              kMinorVersion, 3,       0};
    context_ = osmesa().CreateContextAttribs(attributes, nullptr);
    if (context_ == nullptr) throw Error::system("OSMesa refuses an OpenGL 3.3 core context");
    try {
      make_current();
      describe(osmesa().GetProcAddress);
    } catch (...) {
      osmesa().DestroyContext(context_);
      throw;
    }
  }
  ~OSMesaContext() override {
    osmesa().MakeCurrent(nullptr, nullptr, 0, 0, 0);
    osmesa().DestroyContext(context_);
  }

  void make_current() override {
    if (!osmesa().MakeCurrent(context_, buffer_.data(), GL_UNSIGNED_BYTE, kSide, kSide))
      throw Error::system("OSMesaMakeCurrent fails");
  }

 private:
  // OSMesa insists on a default framebuffer; drawing goes to framebuffer objects.
  static constexpr int kSide = 16;
  std::array<unsigned char, kSide * kSide * 4> buffer_{};
  OSMesaContextRecord* context_ = nullptr;
};

}  // namespace

std::unique_ptr<Offscreen> create_osmesa_context(const Candidate& candidate) {
  return std::make_unique<OSMesaContext>(candidate);
}

}  // namespace hysteron::render
