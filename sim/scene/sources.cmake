# Sources of fabrics and scenes, relative to the project's root.
# Needs: Eigen3::Eigen; Debian's libtomlplusplus-dev (headers only, included by toml_file.cpp alone) and
# nlohmann-json3-dev (headers only; json_fwd.hpp in keys.h).  sim/scene/assets.cpp needs the compile definition
# HYSTERON_SOURCE_DIR="${PROJECT_SOURCE_DIR}".
set(HYSTERON_SCENE_SOURCES
    sim/scene/assets.cpp
    sim/scene/fabric_reader.cpp
    sim/scene/key_table.cpp
    sim/scene/keys.cpp
    sim/scene/phases.cpp
    sim/scene/scene_checks.cpp
    sim/scene/scene_reader.cpp
    sim/scene/toml_file.cpp
    sim/scene/toml_text.cpp)
