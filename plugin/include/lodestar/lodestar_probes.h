/* SPDX-License-Identifier: MIT
 *
 * The extension "lodestar.probes" of Lodestar's C interface: light probes, captured by the host and
 * made into light by the library. The rules are lodestar.h's.
 *
 * How a host goes on, once it lights by plans:
 *     const LodestarProbesApi *probes = api.get_extension(LODESTAR_EXTENSION_PROBES);
 *     probes->probe_create(context, &desc, &probe);    // or document_probes
 *     every frame:
 *     probes->probe_face for each job of earlier plans that has been drawn since
 *     probes->frame_boxes(context, &boxes);            // where the draws of the frame are
 *     api.plan_make(context, &frame, &plan);           // max_faces: how many may be drawn
 *     probes->plan_probe_jobs(context, plan, ...)      // draw these, with what plan_job_draws says
 *     probes->plan_draw_probes(context, plan, ...)     // the two probes of each draw
 *     probes->plan_probe_uniforms for what they need; the texels by plan_probe_cube and
 *     plan_probe_texels, or by `execute` of the extension "lodestar.gl" and probe_texture
 *     The shading text is lodestar.h's, LODESTAR_WITH_PROBES of it 1 or 2.
 *
 * Faces come when the host has drawn them: in the same frame or some frames later. A probe shows
 * what it did before, or nothing, until all faces of a round are there; the first plan after that
 * publishes them together. What the faces do not cover shows the distant environment and the skies,
 * which the library puts behind them, and puts there anew when they change, without a job. Suns are
 * no part of a probe: they light by themselves, times the host's shadow; one that casts none is let
 * through by how much of its direction the faces leave open.
 */
#ifndef LODESTAR_PROBES_H
#define LODESTAR_PROBES_H

#include "lodestar.h"

#ifdef __cplusplus
extern "C" {
#endif

#define LODESTAR_EXTENSION_PROBES "lodestar.probes"

/* A handle, as those of lodestar.h. */
typedef uint64_t LodestarProbe;

enum { LODESTAR_VOLUME_NONE = 0, LODESTAR_VOLUME_BOX = 1, LODESTAR_VOLUME_SPHERE = 2 };

/* A volume about a probe, in metres of the probe's frame. */
typedef struct LodestarProbeVolume {
    int32_t shape; /* LODESTAR_VOLUME_* */
    uint32_t reserved;
    double center[3]; /* from the probe */
    double size[3];   /* full extents, > 0; a sphere's diameter in the first */
    double blend[6];  /* over how many metres the weight falls to 0, at least 0, at +X, -X, +Y, -Y,
                         +Z, -Z; a sphere's in the first. Inside the faces, outside an interior's */
} LodestarProbeVolume;

/* When a probe is captured anew. */
enum {
    LODESTAR_UPDATE_ONCE = 0,      /* when first needed */
    LODESTAR_UPDATE_ON_CHANGE = 1, /* where a face sees something move, or its light has changed */
    LODESTAR_UPDATE_EVERY = 2,     /* every `every` frames */
    LODESTAR_UPDATE_ALWAYS = 3,    /* as often as the faces allow */
    LODESTAR_UPDATE_ON_DEMAND = 4  /* by probe_request */
};

typedef struct LodestarProbeDesc {
    uint32_t struct_size;
    uint32_t interior;  /* 1: no sky and no distant environment lights what is inside */
    const char* name;   /* for the plan's text; may be null */
    double frame[16];   /* world from the probe's frame, affine, column after column; all zero:
                           the world's */
    double position[3]; /* where it captures, in that frame */
    double near_plane, far_plane; /* metres, 0 < near < far */
    uint32_t width;               /* of a face, texels, 1 to 2048; 0 is 128 */
    int32_t update;               /* LODESTAR_UPDATE_* */
    uint32_t every;               /* frames, at least 1 */
    int32_t priority;             /* of two at one point, the higher shows */
    uint32_t layers;              /* what shares a bit with it is captured; 0: everything */
    uint32_t reserved;
    double tint[3], intensity;     /* factors on its light, [0, 1e9] */
    LodestarProbeVolume influence; /* where it lights; it has a shape */
    LodestarProbeVolume proxy;     /* what its reflections are corrected to; may be none */
} LodestarProbeDesc;

/* Where a draw of the next plan is. */
typedef struct LodestarProbeDraw {
    uint32_t struct_size;
    uint32_t layers;        /* 0: all */
    uint64_t id;            /* of one thing the same in all frames; no two of a frame are equal */
    double low[3], high[3]; /* world box about it, finite, low <= high */
    double share;           /* of the picture that it may cover, [0, 1]; 0 where it is not known */
    uint32_t changed;       /* 1: it looks otherwise than in the frame before */
    uint32_t hidden;        /* 1: no probe captures it, whatever the layers */
} LodestarProbeDraw;

/* The draws of the next plan, in the order of LodestarFrame.draws; where those are null, these are
 * the draws. */
typedef struct LodestarProbeFrame {
    uint32_t struct_size;
    uint32_t draw_count;
    uint32_t draw_stride; /* bytes from one to the next: sizeof(LodestarProbeDraw) */
    uint32_t reserved;
    const LodestarProbeDraw* draws;
    double light_threshold; /* relative change of the light at which a probe is captured anew;
                               0 is 0.1 */
} LodestarProbeFrame;

/* A face of a probe that the host is to draw: what plan_job_draws names, nothing elsewhere (colour
 * and coverage 0). Suns and other lights of the host's light it as they do the picture. */
typedef struct LodestarProbeJob {
    uint32_t struct_size;
    int32_t face; /* OpenGL's order */
    LodestarProbe probe;
    double position[3];    /* where it captures, in the world */
    double view[16];       /* camera from world, column after column */
    double projection[16]; /* OpenGL clip space from camera: row 0 of the face is at y = -1 */
    uint32_t width;        /* of the face, texels */
    uint32_t draw_count;
} LodestarProbeJob;

/* The probes that light a draw, the one in front first; 0: none. */
typedef struct LodestarDrawProbes {
    uint32_t struct_size;
    uint32_t draw; /* into the frame's draws */
    LodestarProbe probe[2];
    uint32_t dark[2];  /* 1: it keeps the sky out and gives no light: no texels are bound for it */
    float factor[2];   /* what the draw lets each have, [0, 1] */
    float open;        /* of what they leave, what the sky may light, [0, 1] */
    uint32_t features; /* LODESTAR_FEATURE_*, those below too */
} LodestarDrawProbes;

/* Further bits of LodestarDrawProbes.features and plan_features. */
enum {
    LODESTAR_FEATURE_PROBE = 8,        /* LODESTAR_WITH_PROBES 1 */
    LODESTAR_FEATURE_SECOND_PROBE = 16 /* LODESTAR_WITH_PROBES 2 */
};

/* Vectors of four floats that the shading text reads of a draw's probes: the elements of
 * `lodestar_probes`, of which one probe alone reads the first half, and last
 * `lodestar_probeFactors`. Its samplers are samplerCube `lodestar_probeTexels0` and
 * `lodestar_probeTexels1` (LODESTAR_TEXELS_ENVIRONMENT), `lodestar_probeIrradiance0` and
 * `lodestar_probeIrradiance1` (LODESTAR_TEXELS_IRRADIANCE). */
#define LODESTAR_PROBE_VECTORS 13
#define LODESTAR_PROBE_UNIFORMS 27

typedef struct LodestarProbesApi {
    uint32_t struct_size; /* of what this library has */
    uint32_t reserved;

    /* [main] Values out of range are refused, with a JSON pointer of the member. */
    LodestarStatus (*probe_create)(LodestarContext*, const LodestarProbeDesc*, LodestarProbe*);
    LodestarStatus (*probe_destroy)(LodestarContext*, LodestarProbe);
    /* [main] Replaces all probes by a document's, in their order; they stand in the document's
     * frame, those at a node in that node's once probe_move has said where it is: till then they
     * light nothing. Those that hold a file's light show nothing until probe_hold. */
    LodestarStatus (*document_probes)(LodestarContext*, LodestarDocument);
    /* [main] All probes, in the order of their making: a two-call query, count for size. */
    LodestarStatus (*probes)(LodestarContext*, LodestarProbe* handles, size_t* count);
    /* [main] What a document names, two-call queries in bytes, the closing 0 included: the node
     * that a probe is at, and the file, relative to the document, or analytic text whose light it
     * holds. *size is 0 where it names none. */
    LodestarStatus (*probe_node)(LodestarContext*, LodestarProbe, char* node, size_t* size);
    LodestarStatus (*probe_source)(LodestarContext*, LodestarProbe, char* source, size_t* size);

    /* [main] Where its frame is now: as LodestarProbeDesc.frame. One that is flat or not finite has
     * no inside: the probe lights nothing. */
    LodestarStatus (*probe_move)(LodestarContext*, LodestarProbe, const double frame[16]);
    /* [main] It holds what an environment shows, as it stands, and is never captured. The
     * environment may end then. */
    LodestarStatus (*probe_hold)(LodestarContext*, LodestarProbe, LodestarEnvironment);
    /* [main] All faces are captured anew; what it shows stays until they are there. */
    LodestarStatus (*probe_request)(LodestarContext*, LodestarProbe);

    /* [main] The boxes of the next plan; it has no probes without them. Kept until a plan is made.
     */
    LodestarStatus (*frame_boxes)(LodestarContext*, const LodestarProbeFrame*);
    /* [main] A face as its job of that plan says: width^2 pixels RGBA, row 0 first, radiance
     * premultiplied by the coverage in alpha, [0, 1]. Values out of range are repaired and logged.
     * LODESTAR_MORE: the face is not awaited any more, and is passed over: it came before, or
     * later than three more plans, which makes a plan ask for it again. */
    LodestarStatus (*probe_face)(LodestarContext*, LodestarPlan, LodestarProbe, int32_t face,
                                 const float* pixels);

    /* [any] Two-call queries, count for size. plan_job_draws says of a job, by its place among the
     * jobs, what it draws, in order; plan_draw_probes has an element for each draw of the frame, in
     * the frame's order. Both are of the state before the plan's faces are drawn. */
    LodestarStatus (*plan_probe_jobs)(LodestarContext*, LodestarPlan, LodestarProbeJob*,
                                      size_t* count);
    LodestarStatus (*plan_job_draws)(LodestarContext*, LodestarPlan, uint32_t job,
                                     LodestarDrawProbes*, size_t* count);
    LodestarStatus (*plan_draw_probes)(LodestarContext*, LodestarPlan, LodestarDrawProbes*,
                                       size_t* count);
    /* [any] The uniforms of a draw: LODESTAR_PROBE_UNIFORMS vectors. */
    LodestarStatus (*plan_probe_uniforms)(LodestarContext*, LodestarPlan, const LodestarDrawProbes*,
                                          float*);
    /* [any] A probe's light in a plan. version 0: it has none. The alpha of its environment's
     * texels is how much of a direction the faces cover.
     * @param texels LODESTAR_TEXELS_ENVIRONMENT, _IRRADIANCE */
    LodestarStatus (*plan_probe_cube)(LodestarContext*, LodestarPlan, LodestarProbe, int32_t texels,
                                      LodestarCube*);
    /* [any] A two-call query in bytes. */
    LodestarStatus (*plan_probe_texels)(LodestarContext*, LodestarPlan, LodestarProbe,
                                        int32_t texels, uint32_t level, void* buffer, size_t* size);
    /* [gl] The same as a texture, as the last plan left it that `execute` of the extension
     * "lodestar.gl" was given; that uploads what the plan's draws and jobs are lit by. The name
     * stays until the probe ends; 0: nothing has been lit by it. Read seamlessly.
     * @param texels LODESTAR_TEXELS_ENVIRONMENT, _IRRADIANCE */
    LodestarStatus (*probe_texture)(LodestarContext*, LodestarProbe, int32_t texels,
                                    LodestarGlTexture*);
} LodestarProbesApi;

#ifdef __cplusplus
}
#endif
#endif
