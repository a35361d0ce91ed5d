// SPDX-License-Identifier: MIT
//
// What tent mips cost on the CPU, beside the driver's own mip call for the same cube on the same
// processor (llvmpipe): processor time of the whole process, both in each round, the median of the
// rounds' ratios.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include <epoxy/gl.h>

#include "lighting/environment.h"
#include "lighting/mips.h"
#include "platform/headless_context.h"

namespace {

constexpr int kWidth = 256;
constexpr int kRounds = 101;

double processorMilliseconds() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

template <class Work>
double timed(const Work& work) {
    const double begin = processorMilliseconds();
    work();
    return processorMilliseconds() - begin;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// A cube texture of RGBA16F with level 0 filled and room for all levels, bound.
void makeTexture(const lodestar::lighting::Cubemap& map) {
    GLuint texture = 0;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_CUBE_MAP, texture);
    glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    for (unsigned face = 0; face < 6; ++face) {
        glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, GL_RGBA16F, kWidth, kWidth, 0,
                     GL_RGBA, GL_FLOAT, &map.texel(static_cast<int>(face), 0, 0));
    }
    glGenerateMipmap(GL_TEXTURE_CUBE_MAP); // allocates the levels
    glFinish();
}

} // namespace

int main() {
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    auto context = lodestar::platform::HeadlessContext::create();
    if (!context) {
        std::fprintf(stderr, "bench-mips: %s\n", context.error().message().c_str());
        return 4;
    }
    namespace lighting = lodestar::lighting;
    lighting::Cubemap chain =
        lighting::tentMips(lighting::cubeFromAnalytic(lighting::ClearSkyEnvironment{}, kWidth));
    makeTexture(chain);
    std::vector<double> driver;
    std::vector<double> tent;
    std::vector<double> ratios;
    for (int round = 0; round < kRounds; ++round) {
        driver.push_back(timed([] {
            glGenerateMipmap(GL_TEXTURE_CUBE_MAP);
            glFinish();
        }));
        tent.push_back(timed([&] { lighting::fillTentMips(chain); }));
        ratios.push_back(tent.back() / driver.back());
    }
    std::printf("6 x %d^2, %d rounds, medians of processor time, %s\n", kWidth, kRounds,
                reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
    std::printf("%-28s %8.3f ms\n", "glGenerateMipmap, RGBA16F", median(driver));
    std::printf("%-28s %8.3f ms\n", "fillTentMips, float", median(tent));
    std::printf("%-28s %8.3f\n", "ratio", median(ratios));
    return 0;
}
