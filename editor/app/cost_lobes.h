// SPDX-License-Identifier: MIT
//
// How far direct light by each form of its lobe and of Fresnel's reflectance is from cosine powers
// and Schlick's form in double precision.
#pragma once

#include "lighting/estimator.h"

namespace lodestar::app {

struct LobeErrors {
    double rmse = 0.0;  ///< root mean square over lights, over that of the reference
    double worst = 0.0; ///< greatest difference over the greatest reference of its view
};

/// Of a black surface of F0 = 0.04 under lights all over its hemisphere, seen at n.v = 1, 0.7 and
/// 0.3, by the shading text in float. @param exponent Blinn-Phong, [0, 1e7]
[[nodiscard]] LobeErrors lobeErrors(lighting::LobeForm lobes, lighting::FresnelForm fresnel,
                                    double exponent);

} // namespace lodestar::app
