// SPDX-License-Identifier: MIT
//
// Memory that runs out in the middle of a probe's life; the header in C.
#include "host.h"
#include "probe_host.h"

extern "C" size_t lodestar_test_sizesInC(size_t* frame, size_t* draw, size_t* job, size_t* pair);

namespace lodestar::testing {
namespace {

using AbiProbes = ProbeHost<AbiHost>;

TEST(AbiProbesHeader, IsTheSameInC) {
    std::size_t frame = 0, draw = 0, job = 0, pair = 0;
    EXPECT_EQ(lodestar_test_sizesInC(&frame, &draw, &job, &pair),
              sizeof(LodestarProbeDesc) + sizeof(LodestarProbesApi));
    EXPECT_EQ(frame, sizeof(LodestarProbeFrame));
    EXPECT_EQ(draw, sizeof(LodestarProbeDraw));
    EXPECT_EQ(job, sizeof(LodestarProbeJob));
    EXPECT_EQ(pair, sizeof(LodestarDrawProbes));
}

class AbiProbeMemory : public AbiProbes {
protected:
    /// A probe captured, published and composed. @return the first status that is not OK
    LodestarStatus afternoon(LodestarContext* in) {
        const LodestarProbeDesc desc = [] {
            LodestarProbeDesc small = probeDesc();
            small.width = 2;
            return small;
        }();
        LodestarProbe probe = 0;
        LodestarStatus status = probes->probe_create(in, &desc, &probe);
        for (int round = 0; round < 2 && status == LODESTAR_OK; ++round) {
            LodestarPlan plan = 0;
            status = plans(in, plan);
            std::vector<LodestarProbeJob> asked(6);
            asked[0].struct_size = sizeof asked[0];
            std::size_t count = 6;
            status = status != LODESTAR_OK
                         ? status
                         : probes->plan_probe_jobs(in, plan, asked.data(), &count);
            const float pixels[16] = {};
            for (std::size_t i = 0; i < count && status == LODESTAR_OK; ++i) {
                status = probes->probe_face(in, plan, asked[i].probe, asked[i].face, pixels);
            }
        }
        return status;
    }
    LodestarStatus plans(LodestarContext* in, LodestarPlan& plan) {
        LodestarProbeFrame placed{};
        placed.struct_size = sizeof placed;
        placed.draws = boxes.data();
        placed.draw_count = 1;
        placed.draw_stride = sizeof boxes[0];
        const LodestarStatus status = probes->frame_boxes(in, &placed);
        return status != LODESTAR_OK ? status : api.plan_make(in, &frame, &plan);
    }
};

// Whichever allocation fails, the call says so, and what follows works.
TEST_F(AbiProbeMemory, ThatRunsOutIsAStatus) {
    ASSERT_EQ(afternoon(context), LODESTAR_OK);
    std::size_t calls = 0, failed = 0;
    for (std::size_t at = 0; at == 0 || at < calls; ++at) {
        LodestarContext* other = nullptr;
        const LodestarHost host = counting.host();
        ASSERT_EQ(api.context_create(&host, &other), LODESTAR_OK);
        counting.calls = 0;
        counting.failAt = at;
        const LodestarStatus status = afternoon(other);
        EXPECT_TRUE(status == LODESTAR_E_NOMEM || status == LODESTAR_OK) << "allocation " << at;
        failed += status == LODESTAR_E_NOMEM ? 1 : 0;
        counting.failAt = std::numeric_limits<std::size_t>::max();
        EXPECT_EQ(afternoon(other), LODESTAR_OK) << "the same calls work then, " << at;
        calls = at == 0 ? counting.calls : calls;
        EXPECT_EQ(api.context_destroy(other), LODESTAR_OK);
    }
    EXPECT_GT(failed, 40u);
}

} // namespace
} // namespace lodestar::testing
