// SPDX-License-Identifier: MIT
//
// The rows themselves; included once a precision, after the text. Bounds count roundings e: an
// operation adds one, log2 and exp2 two, a sum of positives keeps the larger relative error; a
// level up to 24 has steps of 32 e.
namespace {

namespace text = lodestar::LODESTAR_NAMESPACE;
using text::Real;

Real real(double x) {
    return static_cast<Real>(x);
}
text::vec3 vector(const double* a) {
    return {real(a[0]), real(a[1]), real(a[2])};
}
/// A unit vector to rounding; its own rounding enters the rows that use two of them.
text::vec3 unit(const double* a) {
    return glm::normalize(vector(a) + text::vec3(real(0.0), real(0.0), real(1e-3)));
}

constexpr lodestar::testing::DualRange kExponent{1e-3, 1e7, true};
constexpr lodestar::testing::DualRange kUnit{0.0, 1.0};
constexpr lodestar::testing::DualRange kSigned{-1.0, 1.0};
constexpr lodestar::testing::DualRange kWidth{1.0, 4096.0, true};

std::vector<lodestar::testing::DualRow> levelRows() {
    return {
        // log2(s + 1) <= 23.3 rounded to 32 e, halved; log2(w sqrt 3) <= 14 to 16 e; their
        // difference
        // 8 e; rounded arguments 1.44 (1 + 0.5) e.
        {"mipLevelUnclamped",
         {kExponent, kWidth},
         50,
         0,
         [](const double* a) {
             return double(text::lodestar_mipLevelUnclamped(real(a[0]), real(a[1])));
         }},
        // The argument of log2, a sum of squares of quotients, is off by 5 e; times 1.44 x 0.75;
        // log2 <= 1.6 to 2 e; difference 1 e.
        {"texelSizeLevel",
         {kSigned, kSigned, kSigned},
         10,
         0,
         [](const double* a) { return double(text::lodestar_texelSizeLevel(vector(a))); }},
        // The two above (50 + 0.72 kappa 0.2 x 36 + 10) and two sums of 8 e.
        {"tentLevel",
         {kSigned, kSigned, kSigned, kExponent, kWidth},
         85,
         0,
         [](const double* a) {
             return double(text::lodestar_tentLevel(vector(a), real(a[3]), real(a[4]), real(13.0)));
         }},
        // log2 <= 20 to 32 e, halved; sum <= 8 to 8 e.
        {"biasLevelAtVertex",
         {{0.0, 8.0}, {1e-6, 1.0, true}},
         26,
         0,
         [](const double* a) {
             return double(text::lodestar_biasLevelAtVertex(real(a[0]), real(a[1])));
         }},
        // u and v each off by 2 e, so 1 + u^2 + v^2 by at most 6 e of itself; its power -3/2 by 9 e
        // and
        // 4 more; 4 / w^2 by 2.
        {"texelSolidAngle",
         {kWidth, kUnit, kUnit},
         0,
         18,
         [](const double* a) {
             const double w = std::floor(a[0]);
             return double(text::lodestar_texelSolidAngle(
                 real(w), real(std::floor(a[1] * (w - 1.0))), real(std::floor(a[2] * (w - 1.0)))));
         }},
        // Texels a pixel over w |dx|: products and differences of order 1 over k^2 >= 1/3, 12 e
        // each;
        // exp2 of a level <= 16: 16 e ln 2 of a value <= 3.
        {"footprintLevel",
         {kSigned, kSigned, kSigned, {0.1, 1.0}, kSigned, kSigned, kWidth},
         110,
         0,
         [](const double* a) {
             const text::vec3 dx = vector(a + 3) * real(0.01);
             const Real level =
                 text::lodestar_footprintLevel(unit(a), dx, text::vec3(real(0.0)), real(a[6]));
             return std::exp2(double(level)) / (double(real(a[6])) * double(glm::length(dx)));
         }},
    };
}

std::vector<lodestar::testing::DualRow> lobeRows() {
    return {
        // 1 - x is off by 1 e of at most 1, its fifth power by 5, products 3.
        {"schlickWeight",
         {kUnit},
         9,
         0,
         [](const double* a) { return double(text::lodestar_schlickWeight(real(a[0]))); }},
        // Two roundings under a fourth root, and two roots.
        {"roughnessFromExponent",
         {kExponent},
         0,
         3,
         [](const double* a) { return double(text::lodestar_roughnessFromExponent(real(a[0]))); }},
        // r^4 by 3 e, the quotient by 4; the difference from 2 keeps it as an absolute error.
        {"exponentFromRoughness",
         {{0.03, 1.0}},
         10,
         5,
         [](const double* a) { return double(text::lodestar_exponentFromRoughness(real(a[0]))); }},
        {"blinnPhongNormaliser",
         {kExponent},
         0,
         10,
         [](const double* a) { return double(text::lodestar_blinnPhongNormaliser(real(a[0]))); }},
        {"phongNormaliser",
         {kExponent},
         0,
         4,
         [](const double* a) { return double(text::lodestar_phongNormaliser(real(a[0]))); }},
        {"phongFromBlinnPhong",
         {kExponent},
         0,
         7,
         [](const double* a) { return double(text::lodestar_phongFromBlinnPhong(real(a[0]))); }},
        // Under the root: (n.v)^2 by 1 e, q by 7 e, 1 - c2 by 1 e of 1, weighted by q: at most 10 e
        // of
        // the sum, halved; the exponent's 7.
        {"lookupExponent",
         {kExponent, kUnit},
         0,
         15,
         [](const double* a) {
             return double(text::lodestar_lookupExponent(real(a[0]), real(a[1])));
         }},
        {"lookupBlend",
         {kExponent, kUnit},
         0,
         12,
         [](const double* a) {
             return double(text::lodestar_lookupBlend(real(a[0]), real(a[1])));
         }},
        {"specularOcclusion",
         {kUnit, kExponent},
         7,
         0,
         [](const double* a) {
             return double(text::lodestar_specularOcclusion(real(a[0]), real(a[1])));
         }},
        {"fresnelEnvironment",
         {kUnit, kUnit, kExponent},
         14,
         0,
         [](const double* a) {
             return double(
                 text::lodestar_fresnelEnvironment(text::vec3(real(a[0])), real(a[1]), real(a[2]))
                     .y);
         }},
        // As a share of the peak. The half vector is off by 4 e, so the chord's square by 8 e
        // sqrt(2d)
        // and s times that by at most 5 e sqrt(s) once the power falls: 500 e at s = 1e4; the
        // rest 60.
        {"directReflectance",
         {kSigned, kSigned, kUnit, kSigned, kSigned, kUnit, {1e-2, 1e4, true}},
         560,
         0,
         [](const double* a) {
             const text::vec3 n(real(0.0), real(0.0), real(1.0));
             const text::vec3 value =
                 text::lodestar_directReflectance(n, unit(a), unit(a + 3), text::vec3(real(0.5)),
                                                  text::vec3(real(0.25)), real(a[6]));
             return double(value.x) /
                    (1.0 + double(text::lodestar_blinnPhongNormaliser(real(a[6]))));
         }},
    };
}

std::vector<lodestar::testing::DualRow> powerRows() {
    return {
        // y = s log2 x is off by 3 e |y|; |y| 2^y <= 0.54 (ln 2 cancels), exp2 2 e.
        {"cosinePower",
         {{1e-3, 1.0}, kExponent},
         5,
         0,
         [](const double* a) {
             return double(text::lodestar_cosinePower(real(a[0]), real(a[1])));
         }},
        // The logarithm a is off by at most 100 e of itself (1 - d at d = 0.01); |a| e^a <= 1 / e.
        {"cosinePowerFromChord",
         {{1e-9, 1.0, true}, kExponent},
         40,
         0,
         [](const double* a) {
             return double(text::lodestar_cosinePowerFromChord(real(a[0]), real(a[1])));
         }},
        // Nine terms of at most 2, each by 4 e.
        {"sh9",
         {kSigned, kSigned, kSigned},
         72,
         0,
         [](const double* a) {
             const auto c = [](double x) { return text::vec3(real(x)); };
             return double(text::lodestar_sh9(c(0.75), c(0.5), c(-0.25), c(0.125), c(0.5), c(-0.5),
                                              c(0.25), c(0.375), c(-0.125), unit(a))
                               .x);
         }},
        // log2 <= 8.4 by 2 e of itself, times 0.417 ln 2, and three more; the two pieces meet to
        // 1e-8.
        {"srgbFromLinear",
         {{1e-4, 1.0}},
         14,
         0,
         [](const double* a) { return double(text::lodestar_srgbFromLinear(real(a[0]))); }},
        {"linearFromSrgb",
         {kUnit},
         24,
         0,
         [](const double* a) { return double(text::lodestar_linearFromSrgb(real(a[0]))); }},
        // Two cubics of positives by 6 e each, and a quotient.
        {"filmic",
         {{1e-4, 1e4, true}},
         14,
         0,
         [](const double* a) { return double(text::lodestar_filmic(real(a[0]))); }},
    };
}

std::vector<lodestar::testing::DualRow> allRows() {
    std::vector<lodestar::testing::DualRow> rows;
    for (const auto& group : {levelRows(), lobeRows(), powerRows()}) {
        rows.insert(rows.end(), group.begin(), group.end());
    }
    return rows;
}

} // namespace
