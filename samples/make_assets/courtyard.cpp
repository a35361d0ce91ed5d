// SPDX-License-Identifier: MIT
//
// The courtyard, by a small ray caster: four arcaded walls about a tiled floor. North (-Z) has red
// awnings, east (+X) ochre ones and a tower, south (+Z) green, west (-X) blue: a reflection shows
// at once which way it looks.
#include "panorama.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "noise.h"

namespace lodestar::samples {
namespace {

constexpr float kEyeHeight = 1.6f;
constexpr float kHalfX = 11.0f; ///< of the open court, metres
constexpr float kHalfZ = 9.0f;
constexpr float kThickness = 0.6f; ///< of the arcade wall
constexpr float kGallery = 3.0f;   ///< depth of the walk behind it
constexpr float kCeiling = 3.9f;   ///< of the walk
constexpr float kWallTop = 5.6f;
constexpr float kBay = 2.75f; ///< width of one arch with its pier
constexpr float kArchHalf = 0.95f;
constexpr float kSpring = 2.3f; ///< where the arch's round begins
constexpr float kFar = 1e6f;

/// What the sun and the bright sky about it give a facing surface, irradiance over pi.
const glm::vec3 kSunLight{2.0f, 1.6f, 1.12f};

struct Hit {
    float distance = kFar;
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f, 1.0f, 0.0f};
    glm::vec3 albedo{0.5f};
    glm::vec3 glow{0.0f};
    float shelter = 1.0f; ///< share of the sky that is open, roughly
};

/// One side of the court in its own axes: x along the wall, y up, z outwards from the court.
struct Side {
    int index;
    glm::vec3 along;
    glm::vec3 outward;
    float distance; ///< of the wall's inner face from the centre
    glm::vec3 plaster;
    glm::vec3 awning;
};

const std::array<Side, 4>& sides() {
    static const std::array<Side, 4> kSides = {{
        {0, {1, 0, 0}, {0, 0, -1}, kHalfZ, {0.66f, 0.50f, 0.36f}, {0.62f, 0.07f, 0.05f}},
        {1, {0, 0, 1}, {1, 0, 0}, kHalfX, {0.72f, 0.58f, 0.40f}, {0.85f, 0.45f, 0.05f}},
        {2, {-1, 0, 0}, {0, 0, 1}, kHalfZ, {0.60f, 0.44f, 0.36f}, {0.06f, 0.38f, 0.20f}},
        {3, {0, 0, -1}, {-1, 0, 0}, kHalfX, {0.62f, 0.50f, 0.44f}, {0.06f, 0.16f, 0.55f}},
    }};
    return kSides;
}

glm::vec3 toSide(const Side& side, const glm::vec3& v) {
    return {glm::dot(v, side.along), v.y, glm::dot(v, side.outward)};
}

glm::vec3 fromSide(const Side& side, const glm::vec3& v) {
    return side.along * v.x + glm::vec3(0.0f, v.y, 0.0f) + side.outward * v.z;
}

/// Position within an arch's bay, from its middle.
float bayOffset(float x) {
    return x - kBay * std::round(x / kBay);
}

bool inOpening(float x, float y) {
    const float u = std::abs(bayOffset(x));
    if (y < 0.0f || u > kArchHalf) {
        return false;
    }
    return y < kSpring || u * u + (y - kSpring) * (y - kSpring) < kArchHalf * kArchHalf;
}

void take(Hit& hit, float distance, const glm::vec3& position, const glm::vec3& normal,
          const glm::vec3& albedo, float shelter) {
    hit.distance = distance;
    hit.position = position;
    hit.normal = normal;
    hit.albedo = albedo;
    hit.shelter = shelter;
    hit.glow = glm::vec3(0.0f);
}

/// Colour of the arcade's face: plaster, stone about the arches, a cornice, windows above.
glm::vec3 faceAlbedo(const Side& side, float x, float y) {
    const float grain = 0.86f + 0.28f * fractalNoise(x * 1.3f, y * 1.3f, 4, 10 + side.index);
    glm::vec3 colour = side.plaster * grain;
    const float u = std::abs(bayOffset(x));
    const float round = y < kSpring ? u : std::hypot(u, y - kSpring);
    const glm::vec3 stone = glm::vec3(0.70f, 0.66f, 0.58f) * grain;
    if (round < kArchHalf + 0.22f && y < kSpring + kArchHalf + 0.22f) {
        const float angle =
            y < kSpring ? y * 1.6f : kSpring * 1.6f + std::atan2(y - kSpring, u) * 4.0f;
        colour = stone * (std::abs(angle - std::round(angle)) < 0.06f ? 0.62f : 1.0f);
    }
    if ((y > 3.75f && y < 3.95f) || y > kWallTop - 0.25f || y < 0.35f) {
        colour = stone;
    }
    if (u < 0.42f && y > 4.15f && y < 5.15f) { // a window with shutters
        const bool shutter = u > 0.24f;
        const float slat = std::sin(y * 60.0f) > 0.0f ? 1.0f : 0.7f;
        colour = shutter ? (side.awning * 0.6f + 0.05f) * slat : glm::vec3(0.035f, 0.045f, 0.06f);
    }
    return colour;
}

/// The arcade wall: a slab pierced by arches.
void hitArcade(const Side& side, const glm::vec3& o, const glm::vec3& d, Hit& hit) {
    if (std::abs(d.z) < 1e-6f) {
        return;
    }
    float near = (side.distance - o.z) / d.z;
    float far = (side.distance + kThickness - o.z) / d.z;
    float facing = -1.0f;
    if (near > far) {
        std::swap(near, far);
        facing = 1.0f;
    }
    if (near < 1e-3f || near >= hit.distance) {
        return;
    }
    glm::vec3 p = o + d * near;
    const float halfLength = side.index % 2 == 0 ? kHalfX : kHalfZ;
    if (p.y > kWallTop || p.y < 0.0f || std::abs(p.x) > halfLength + kThickness) {
        return;
    }
    if (!inOpening(p.x, p.y)) {
        take(hit, near, p, {0.0f, 0.0f, facing}, faceAlbedo(side, p.x, p.y),
             facing < 0.0f ? 0.8f : 0.3f);
        return;
    }
    const glm::vec3 q = o + d * far;
    if (inOpening(q.x, q.y) && std::abs(bayOffset(q.x) - bayOffset(p.x) - (q.x - p.x)) < 1e-3f) {
        return;
    }
    float inside = near; // the ray ends on the jamb between: bisect, an opening is convex
    float outside = far;
    for (int i = 0; i < 14; ++i) {
        const float middle = 0.5f * (inside + outside);
        const glm::vec3 m = o + d * middle;
        const bool sameBay = std::abs(bayOffset(p.x) + (m.x - p.x)) <= kArchHalf;
        (sameBay && inOpening(m.x, m.y) ? inside : outside) = middle;
    }
    p = o + d * inside;
    const float u = bayOffset(p.x);
    const glm::vec3 normal = p.y < kSpring ? glm::vec3(u > 0.0f ? -1.0f : 1.0f, 0.0f, 0.0f)
                                           : glm::normalize(glm::vec3(-u, kSpring - p.y, 0.0f));
    take(hit, inside, p, normal, {0.62f, 0.57f, 0.50f}, 0.45f);
}

/// The walk behind the arches: its back wall with doors, its ceiling with lamps.
void hitGallery(const Side& side, const glm::vec3& o, const glm::vec3& d, Hit& hit) {
    const float back = side.distance + kThickness + kGallery;
    const float t = (back - o.z) / d.z;
    if (d.z > 1e-6f && t > 1e-3f && t < hit.distance) {
        const glm::vec3 p = o + d * t;
        if (p.y >= 0.0f && p.y <= kCeiling) {
            const float grain = 0.85f + 0.3f * fractalNoise(p.x, p.y, 3, 30 + side.index);
            take(hit, t, p, {0.0f, 0.0f, -1.0f}, side.plaster * grain, 0.22f);
            const float u = bayOffset(p.x - 0.5f * kBay * static_cast<float>(side.index % 2));
            if (std::abs(u) < 0.6f && p.y < 2.3f) {
                hit.albedo = side.awning * 0.35f + 0.04f;
            }
            const float lamp = std::hypot(bayOffset(p.x - 0.5f * kBay), p.y - 2.35f);
            hit.glow = glm::vec3(1.0f, 0.58f, 0.24f) *
                       (lamp < 0.16f ? 14.0f : 0.30f / (0.5f + lamp * lamp * 3.0f));
        }
    }
    const float top = (kCeiling - o.y) / d.y;
    if (d.y > 1e-6f && top > 1e-3f && top < hit.distance) {
        const glm::vec3 p = o + d * top;
        if (p.z > side.distance && p.z < back) {
            take(hit, top, p, {0.0f, -1.0f, 0.0f}, glm::vec3(0.42f, 0.36f, 0.30f), 0.15f);
        }
    }
}

/// Awnings: cloths sloping out from the wall over every second arch.
void hitAwnings(const Side& side, const glm::vec3& o, const glm::vec3& d, Hit& hit) {
    // The plane falls from (y 3.70, z wall) to (y 3.05, z wall - 1.5).
    const glm::vec3 normal = glm::normalize(glm::vec3(0.0f, 1.5f, -0.65f));
    const glm::vec3 anchor{0.0f, 3.70f, side.distance};
    const float facing = glm::dot(d, normal);
    const float t = glm::dot(anchor - o, normal) / facing;
    if (std::abs(facing) < 1e-6f || t < 1e-3f || t >= hit.distance) {
        return;
    }
    const glm::vec3 p = o + d * t;
    const float out = side.distance - p.z;
    const int bay = static_cast<int>(std::round(p.x / kBay));
    const float halfLength = side.index % 2 == 0 ? kHalfX : kHalfZ;
    if (out < 0.0f || out > 1.5f || (bay & 1) != 0 || std::abs(bayOffset(p.x)) > 1.2f ||
        std::abs(p.x) > halfLength - 1.0f) {
        return;
    }
    const bool stripe = std::fmod(std::abs(bayOffset(p.x)) + 0.15f, 0.6f) < 0.3f;
    const glm::vec3 cloth = stripe ? side.awning : glm::vec3(0.80f, 0.76f, 0.68f);
    take(hit, t, p, facing < 0.0f ? normal : -normal, cloth, 0.8f);
    if (facing > 0.0f) {
        hit.glow = cloth * glm::vec3(0.45f, 0.40f, 0.32f); // light through the cloth
    }
}

/// The floor: two-coloured tiles within bands, a round inlay in the middle.
glm::vec3 floorAlbedo(const glm::vec3& p) {
    const float grain = 0.8f + 0.4f * fractalNoise(p.x * 2.0f, p.z * 2.0f, 4, 50);
    const int tile = (static_cast<int>(std::floor(p.x)) + static_cast<int>(std::floor(p.z))) & 1;
    glm::vec3 colour = tile != 0 ? glm::vec3(0.50f, 0.36f, 0.26f) : glm::vec3(0.24f, 0.20f, 0.18f);
    const float bandX = std::abs(p.x - 5.0f * std::round(p.x / 5.0f));
    const float bandZ = std::abs(p.z - 5.0f * std::round(p.z / 5.0f));
    if (std::min(bandX, bandZ) < 0.16f || std::abs(p.x) > kHalfX || std::abs(p.z) > kHalfZ) {
        colour = {0.62f, 0.57f, 0.50f};
    }
    const float radius = std::hypot(p.x, p.z);
    if (radius < 3.2f) {
        // A star: points of two colours that thin outwards, a pale rim, a dark heart.
        const float petal = std::cos(std::atan2(p.x, -p.z) * 12.0f);
        colour = petal > 0.6f * radius - 0.9f ? glm::vec3(0.52f, 0.30f, 0.16f)
                                              : glm::vec3(0.13f, 0.22f, 0.27f);
        if (radius > 2.9f || std::abs(radius - 1.1f) < 0.12f) {
            colour = {0.64f, 0.58f, 0.49f};
        } else if (radius < 0.98f) {
            colour = petal > 0.0f ? glm::vec3(0.16f, 0.13f, 0.12f) : glm::vec3(0.60f, 0.52f, 0.40f);
        }
    }
    const float jointX = std::abs(p.x - std::round(p.x));
    const float jointZ = std::abs(p.z - std::round(p.z));
    return colour * grain * (std::min(jointX, jointZ) < 0.02f ? 0.6f : 1.0f);
}

/// A sphere or an upright box, for what stands in and above the court.
void hitSphere(const glm::vec3& c, float r, const glm::vec3& albedo, const glm::vec3& o,
               const glm::vec3& d, Hit& hit) {
    const glm::vec3 m = o - c;
    const float b = glm::dot(m, d);
    const float disc = b * b - glm::dot(m, m) + r * r;
    if (disc < 0.0f) {
        return;
    }
    const float t = -b - std::sqrt(disc);
    if (t > 1e-3f && t < hit.distance) {
        const glm::vec3 p = o + d * t;
        const glm::vec3 n = (p - c) / r;
        const float leaf = 0.55f + 0.9f * fractalNoise(n.x * 9.0f + n.z * 5.0f, n.y * 9.0f, 3, 70);
        take(hit, t, p, n, albedo * leaf, 0.7f);
    }
}

void hitBox(const glm::vec3& lo, const glm::vec3& hi, const glm::vec3& albedo, const glm::vec3& o,
            const glm::vec3& d, Hit& hit) {
    const glm::vec3 a = (lo - o) / d;
    const glm::vec3 b = (hi - o) / d;
    const glm::vec3 first = glm::min(a, b);
    const glm::vec3 last = glm::max(a, b);
    const float t = std::max({first.x, first.y, first.z});
    if (!(t > 1e-3f) || t > std::min({last.x, last.y, last.z}) || t >= hit.distance) {
        return;
    }
    glm::vec3 normal{0.0f};
    const int axis = t == first.x ? 0 : (t == first.y ? 1 : 2);
    normal[axis] = d[axis] > 0.0f ? -1.0f : 1.0f;
    const glm::vec3 p = o + d * t;
    const float grain = 0.85f + 0.3f * fractalNoise(p.x + p.z, p.y, 3, 90);
    take(hit, t, p, normal, albedo * grain, 0.8f);
}

void hitFurniture(const glm::vec3& o, const glm::vec3& d, Hit& hit) {
    const glm::vec3 leaf{0.10f, 0.20f, 0.05f};
    const glm::vec3 clay{0.50f, 0.21f, 0.10f};
    for (const glm::vec3 at : {glm::vec3(-8.8f, 0.0f, -6.9f), glm::vec3(8.8f, 0.0f, -6.9f),
                               glm::vec3(8.8f, 0.0f, 6.9f), glm::vec3(-8.8f, 0.0f, 6.9f),
                               glm::vec3(-3.0f, 0.0f, -7.6f), glm::vec3(3.0f, 0.0f, 7.6f)}) {
        hitBox(at - glm::vec3(0.4f, 0.0f, 0.4f), at + glm::vec3(0.4f, 0.8f, 0.4f), clay, o, d, hit);
        hitSphere(at + glm::vec3(0.0f, 1.45f, 0.0f), 0.8f, leaf, o, d, hit);
    }
    // The tower behind the eastern wall, its belfry and roof.
    const glm::vec3 brick{0.56f, 0.33f, 0.22f};
    hitBox({15.0f, 0.0f, -9.0f}, {19.0f, 13.0f, -5.0f}, brick, o, d, hit);
    hitBox({14.7f, 11.2f, -9.3f}, {19.3f, 11.6f, -4.7f}, {0.7f, 0.66f, 0.58f}, o, d, hit);
    hitBox({15.6f, 13.0f, -8.4f}, {18.4f, 14.2f, -5.6f}, {0.28f, 0.30f, 0.28f}, o, d, hit);
    // Roofs and a dome beyond the northern wall.
    hitBox({-19.0f, 0.0f, -22.0f}, {-9.0f, 8.0f, -16.0f}, {0.60f, 0.44f, 0.30f}, o, d, hit);
    hitSphere({-3.0f, 6.2f, -22.0f}, 4.2f, {0.30f, 0.36f, 0.33f}, o, d, hit);
}

Hit trace(const glm::vec3& origin, const glm::vec3& direction) {
    Hit hit;
    const float ground = -origin.y / direction.y;
    if (direction.y < -1e-6f && ground > 1e-3f) {
        const glm::vec3 p = origin + direction * ground;
        const bool covered = std::abs(p.x) > kHalfX || std::abs(p.z) > kHalfZ;
        take(hit, ground, p, {0.0f, 1.0f, 0.0f}, floorAlbedo(p), covered ? 0.25f : 0.85f);
    }
    hitFurniture(origin, direction, hit);
    for (const Side& side : sides()) {
        const glm::vec3 o = toSide(side, origin);
        const glm::vec3 d = toSide(side, direction);
        Hit local;
        local.distance = hit.distance;
        hitArcade(side, o, d, local);
        hitGallery(side, o, d, local);
        hitAwnings(side, o, d, local);
        if (local.distance < hit.distance) {
            hit = local;
            hit.position = fromSide(side, local.position);
            hit.normal = fromSide(side, local.normal);
        }
    }
    return hit;
}

/// The sky without its disc: blue above, warm towards the sun, thin clouds on a plane.
glm::vec3 skyRadiance(const glm::vec3& d) {
    const float up = std::max(d.y, 0.0f);
    const float towards = std::max(glm::dot(d, courtyardSun().direction), 0.0f);
    const float depth = std::pow(1.0f - up, 3.0f);
    glm::vec3 sky = glm::mix(glm::vec3(0.20f, 0.42f, 0.95f), glm::vec3(1.05f, 1.02f, 1.00f), depth);
    sky += glm::vec3(1.3f, 0.78f, 0.36f) * (0.6f * std::pow(towards, 6.0f));
    sky += glm::vec3(9.0f, 6.6f, 4.2f) * std::pow(towards, 400.0f);
    const float scale = 2.2f / (up + 0.16f);
    const float x = d.x * scale;
    const float z = d.z * scale;
    const float warp = fractalNoise(x * 0.7f + 7.0f, z * 0.7f, 3, 5);
    const float cloud = fractalNoise(x * 0.8f + warp * 1.6f, z * 1.5f + warp, 6, 1);
    const float cover = smoothStep(0.50f, 0.74f, cloud) * smoothStep(0.02f, 0.22f, up);
    const glm::vec3 lit =
        glm::vec3(1.55f, 1.38f, 1.20f) + glm::vec3(2.2f, 1.5f, 0.9f) * std::pow(towards, 6.0f);
    const glm::vec3 shade{0.62f, 0.64f, 0.74f};
    const glm::vec3 body = glm::mix(lit, shade, smoothStep(0.62f, 0.86f, cloud));
    return glm::mix(sky, body, 0.85f * cover);
}

} // namespace

SunDisc courtyardSun() {
    const glm::vec3 towards = glm::normalize(glm::vec3(-0.66f, 0.50f, 0.56f));
    // A disc of radius 0.25 degrees fills 5.98e-5 sr; over pi, 1e5 of it is 1.9: with the glow
    // about it what kSunLight says.
    return {towards, 0.25f * 0.01745329252f, glm::vec3(100000.0f, 78000.0f, 53000.0f)};
}

glm::vec3 courtyardRadiance(const glm::vec3& direction) {
    const glm::vec3 eye{0.0f, kEyeHeight, 0.0f};
    const Hit hit = trace(eye, direction);
    if (hit.distance >= kFar) {
        return skyRadiance(direction);
    }
    const glm::vec3 towards = courtyardSun().direction;
    const float facing = glm::dot(hit.normal, towards);
    float sun = 0.0f;
    if (facing > 0.0f) {
        const glm::vec3 lifted = hit.position + hit.normal * 5e-3f;
        sun = trace(lifted, towards).distance >= kFar ? facing : 0.0f;
    }
    // The sky from above, and warm light thrown back by the sunlit floor and walls.
    const float upward = 0.5f + 0.5f * hit.normal.y;
    const glm::vec3 ambient = (glm::vec3(0.52f, 0.60f, 0.78f) * (0.35f + 0.65f * upward) +
                               glm::vec3(0.36f, 0.26f, 0.18f) * (1.0f - 0.6f * upward)) *
                              hit.shelter;
    return hit.albedo * (kSunLight * sun + ambient) + hit.glow * 0.35f;
}

} // namespace lodestar::samples
