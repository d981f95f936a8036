// Letters that a glass tube can be bent to, in a box 1 wide and 1.4 high.
#include <algorithm>
#include <string>
#include <vector>

#include "captures/scenarios/modeling.h"
#include "captures/scenarios/night_market/night_market.h"

namespace strata::scenario::market {
namespace {

struct Letter {
    char name;
    std::vector<std::vector<glm::vec2>> strokes;
};

const std::vector<Letter>& letters() {
    static const std::vector<Letter> all = {
        {'S',
         {{{1, 1.2f},
           {0.8f, 1.4f},
           {0.2f, 1.4f},
           {0, 1.2f},
           {0, 0.9f},
           {0.2f, 0.7f},
           {0.8f, 0.7f},
           {1, 0.5f},
           {1, 0.2f},
           {0.8f, 0},
           {0.2f, 0},
           {0, 0.2f}}}},
        {'T', {{{0, 1.4f}, {1, 1.4f}}, {{0.5f, 1.35f}, {0.5f, 0}}}},
        {'R', {{{0, 0}, {0, 1.4f}, {0.7f, 1.4f}, {1, 1.2f}, {1, 0.9f}, {0.7f, 0.7f}, {0.1f, 0.7f}}, {{0.5f, 0.66f}, {1, 0}}}},
        {'A', {{{0, 0}, {0.45f, 1.4f}, {0.55f, 1.4f}, {1, 0}}, {{0.22f, 0.55f}, {0.78f, 0.55f}}}},
        {'O', {{{0.3f, 0}, {0, 0.3f}, {0, 1.1f}, {0.3f, 1.4f}, {0.7f, 1.4f}, {1, 1.1f}, {1, 0.3f}, {0.7f, 0}, {0.35f, 0}}}},
        {'D', {{{0, 0}, {0, 1.4f}, {0.6f, 1.4f}, {1, 1}, {1, 0.4f}, {0.6f, 0}, {0.1f, 0}}}},
        {'L', {{{0, 1.4f}, {0, 0.12f}, {0.12f, 0}, {0.9f, 0}}}},
        {'E', {{{1, 1.4f}, {0.12f, 1.4f}, {0, 1.28f}, {0, 0.12f}, {0.12f, 0}, {1, 0}}, {{0.05f, 0.7f}, {0.8f, 0.7f}}}},
        {'N', {{{0, 0}, {0, 1.4f}}, {{0.06f, 1.35f}, {0.94f, 0.05f}}, {{1, 0}, {1, 1.4f}}}},
        {'B',
         {{{0, 0}, {0, 1.4f}, {0.7f, 1.4f}, {0.9f, 1.2f}, {0.9f, 0.9f}, {0.7f, 0.72f}, {0.1f, 0.72f}},
          {{0.7f, 0.66f}, {1, 0.45f}, {1, 0.2f}, {0.7f, 0}, {0.1f, 0}}}},
        {'P', {{{0, 0}, {0, 1.4f}, {0.7f, 1.4f}, {1, 1.2f}, {1, 0.9f}, {0.7f, 0.7f}, {0.1f, 0.7f}}}},
    };
    return all;
}

}  // namespace

Mesh neon_letters(const std::string& text, float meters, Lettering lettering) {
    Mesh mesh;
    mesh.name = text;
    const float scale = meters / 1.4f;
    glm::vec3 at(0);
    for (const char name : text) {
        const auto letter = std::ranges::find(letters(), name, &Letter::name);
        for (const std::vector<glm::vec2>& stroke : letter->strokes) {
            std::vector<glm::vec3> line;
            for (const glm::vec2& point : stroke) line.push_back(at + scale * glm::vec3(point, 0));
            part::pipe(mesh, line, 0.035f * meters, 6);
        }
        at += lettering == Lettering::along ? glm::vec3(1.4f * scale, 0, 0) : glm::vec3(0, -1.8f * scale, 0);
    }
    return mesh;
}

}  // namespace strata::scenario::market
