# Sources of the cloth mesh, relative to the project's root.
set(HYSTERON_MESH_SOURCES
    sim/atomic_file.cpp
    sim/mesh/builders.cpp
    sim/mesh/delaunay.cpp
    sim/mesh/disc.cpp
    sim/mesh/random_points.cpp
    sim/mesh/topology.cpp)
