#include "tests/9_speed/peer/spheres.h"

#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>

#include "capture_format/frame.h"
#include "capture_format/reader.h"

namespace strata::peer {
namespace {

constexpr std::uint32_t none = ~0u;

bool is_plain(const Frame& frame) {
    const bool is_diffuse = std::ranges::all_of(frame.materials, [](const Material& m) {
        return m.lighting_model == LightingModel::lambert && m.alpha_mode == AlphaMode::blend && m.double_sided;
    });
    return is_diffuse && frame.textures.empty() && frame.lights.empty() && frame.emitters.empty() && frame.fog.density == 0 &&
           frame.view.samples == 1;
}

/// Appends the vertices of a mesh as its triangles share them, and the triangles.
void add_corners(const Mesh& mesh, Sharing sharing, const std::vector<Vertex>& own, Spheres& spheres) {
    std::vector<std::uint32_t> corners(mesh.indices.size(), none), vertex_of(own.size(), none);
    const auto add = [&](std::size_t corner) {
        spheres.vertices.push_back(own[mesh.indices[corner]]);
        return static_cast<std::uint32_t>(spheres.vertices.size() - 1);
    };
    for (std::size_t i = 0; i < corners.size() && sharing == Sharing::all_but_first; i += 3)
        corners[i] = vertex_of[mesh.indices[i]] = add(i);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        std::uint32_t& shared = vertex_of[mesh.indices[i]];
        if (shared == none || sharing == Sharing::none) shared = add(i);
        if (corners[i] == none) corners[i] = shared;
    }
    spheres.indices.insert(spheres.indices.end(), corners.begin(), corners.end());
}

void add_draw(const Frame& frame, const Draw& draw, Sharing sharing, Spheres& spheres) {
    const Mesh& mesh = frame.meshes[draw.mesh];
    const glm::dmat4 to_view = glm::translate(glm::dmat4(frame.view.to_view), -frame.view.origin) * draw.to_world;
    const glm::dmat3 normals = glm::transpose(glm::inverse(glm::dmat3(to_view)));
    std::vector<Vertex> own;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        own.push_back({glm::vec3(to_view * glm::dvec4(mesh.positions[i], 1)),
                       glm::vec3(glm::normalize(normals * glm::dvec3(mesh.normals[i]))),
                       frame.materials[draw.material].base_color});
    add_corners(mesh, sharing, own, spheres);
}

}  // namespace

Result<Spheres> read_spheres(const std::filesystem::path& path, Sharing sharing) {
    const Result<Capture> capture = Capture::open(path);
    if (!capture) return capture.error();
    const Result<Frame> frame = capture->frame(0);
    if (!frame) return frame.error();
    if (!is_plain(*frame))
        return fail(Fault::usage, "peer.not_plain",
                    "{path} is not of two-sided lambert surfaces alone; record spheres_1024 for the peer", path.string());
    Spheres spheres;
    for (const Draw& draw : frame->draws) add_draw(*frame, draw, sharing, spheres);
    spheres.scene = {.to_clip = frame->view.projection,
                     .sky = frame->hemisphere.sky,
                     .ground = frame->hemisphere.ground,
                     .background = frame->background,
                     .width = frame->view.width,
                     .up = glm::vec3(frame->view.to_view[1]),
                     .height = frame->view.height};
    return spheres;
}

}  // namespace strata::peer
