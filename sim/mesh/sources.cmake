# Sources of the cloth mesh, relative to the project's root.
set(HYSTERON_MESH_SOURCES
    sim/atomic_file.cpp
    sim/whole_file.cpp
    sim/mesh/builders.cpp
    sim/mesh/delaunay.cpp
    sim/mesh/disc.cpp
    sim/mesh/obj_soup.cpp
    sim/mesh/ply_header.cpp
    sim/mesh/random_points.cpp
    sim/mesh/read_obj.cpp
    sim/mesh/surface.cpp
    sim/mesh/topology.cpp
    sim/mesh/tube.cpp
    sim/mesh/weld.cpp
    sim/mesh/write_mesh.cpp)
