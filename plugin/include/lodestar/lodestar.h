/* SPDX-License-Identifier: MIT
 *
 * Lodestar's C interface: painted skies and suns (radially symmetric reflection maps) and
 * environments for a host that has its own renderer. C11; no GL header, nothing of C++ crosses it.
 *
 * How a host begins:
 *     LodestarApi api = {.struct_size = sizeof api};
 *     if (lodestar_get_api(LODESTAR_ABI_VERSION, &api) != LODESTAR_OK) ...
 *     LodestarContext *context;
 *     api.context_create(&host, &context);
 *     api.document_load(context, text, size, &document);   // what an artist saved, or light_create
 *     api.document_apply(context, document);
 *     every frame: api.plan_make(context, &frame, &plan), then plan_uniforms, and the texels that
 *     plan_lights says are new: by light_texels, or by `execute` of the extension "lodestar.gl".
 *     The shading text is api.glsl_text("plugin/lighting.glsl").
 *
 * What it does not do: it makes no window, opens no file, starts no thread and loads no scene; it
 * draws nothing: faces of captured environments are jobs for the host, and so are shadows. It makes
 * no GL call but in the extension "lodestar.gl".
 *
 * Rules
 * - Every struct that a host fills begins with struct_size = sizeof of it: members that a host's
 * header did not have yet are taken as 0, those that this library does not know must be 0.
 * - Threads: [main] functions of a context are called on the thread that created it, [gl] functions
 *   on the thread that attached its OpenGL context, which may be another; either kind one at a
 * time, both kinds at once. [any] functions are called on any thread while the context lives, and
 * say what fails by their status alone.
 * - Ownership: what a host passes is copied; what it gets by two-call queries is its own. In a
 *   two-call query `*size` is set to what is needed, and LODESTAR_MORE says that the buffer was
 * null or smaller; nothing is written then.
 * - Errors are statuses; last_error says the same in words, on the thread that it was said to.
 * Memory that runs out gives LODESTAR_E_NOMEM and leaves everything as it was.
 * - Text is UTF-8. Vectors are right-handed, in the host's frame: LodestarHost says which way is up
 *   and which north, a document's +Y and -Z. A sky's axis is up, axes point towards the light,
 *   colours are linear Rec. 709, hours local solar time in [0, 24).
 */
#ifndef LODESTAR_H
#define LODESTAR_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define LODESTAR_EXPORT __attribute__((visibility("default")))
#else
#define LODESTAR_EXPORT
#endif

#define LODESTAR_ABI_MAJOR 1u
#define LODESTAR_ABI_MINOR 0u
/* What the host was compiled against; the major number must be the library's. */
#define LODESTAR_ABI_VERSION (LODESTAR_ABI_MAJOR << 16 | LODESTAR_ABI_MINOR)

typedef int32_t LodestarStatus;
enum {
    LODESTAR_OK = 0,
    LODESTAR_MORE = 1,           /* a buffer was null or too small */
    LODESTAR_E_ABI = -1,         /* another major version, or a struct_size that is none */
    LODESTAR_E_ARG = -2,         /* a null, stale or invalid argument */
    LODESTAR_E_NOMEM = -3,       /* the host's allocator gave null */
    LODESTAR_E_STATE = -4,       /* a bug of this library; the context should be destroyed */
    LODESTAR_E_UNSUPPORTED = -5, /* known, but not by this build */
    LODESTAR_E_THREAD = -6,      /* a [main] or [gl] function on another thread */
    LODESTAR_E_DOCUMENT = -7     /* a document was refused; last_error names the JSON pointer */
};

/* Numbers of what is logged. */
enum {
    LODESTAR_LOG_REPAIRED = 100, /* a value was repaired or left out: the rule, and how often */
    LODESTAR_LOG_REFUSED = 200   /* a call was refused: last_error's words */
};

typedef struct LodestarContext LodestarContext;
/* Handles: 0 is none; one that was destroyed is stale for ever. */
typedef uint64_t LodestarLight;
typedef uint64_t LodestarDocument;
typedef uint64_t LodestarEnvironment;
/* The plan of one frame, immutable: the last four of a context are kept, older ones are stale. */
typedef uint64_t LodestarPlan;

/* What a host gives. All functions may be null. */
typedef struct LodestarHost {
    uint32_t struct_size;
    uint32_t reserved;
    void* user; /* passed back to every function */
    /* Both or none; alignment 16. Called on the thread of the call that needs memory. Tables that
     * all contexts share are not of it: some megabytes of the C library's, until the library goes.
     */
    void* (*allocate)(void* user, size_t size);
    void (*release)(void* user, void* memory);
    void (*log)(void* user, int32_t number, const char* utf8);
    /* The host's frame, both or none (then +Y and -Z), of any length: north is taken across up. */
    double up[3], north[3];
} LodestarHost;

enum { LODESTAR_SKY = 0, LODESTAR_SUN = 1 };
enum {
    LODESTAR_INTERPOLATION_LINEAR = 0,
    LODESTAR_INTERPOLATION_CONSTANT = 1,
    LODESTAR_INTERPOLATION_SMOOTH = 2,
    LODESTAR_INTERPOLATION_CUBIC = 3
};
enum { LODESTAR_SPACE_LINEAR = 0, LODESTAR_SPACE_OKLAB = 1, LODESTAR_SPACE_SRGB = 2 };

typedef struct LodestarStop {
    double at; /* degrees: elevation [-90, 90] of a sky, angle from the axis [0, 180] of a sun */
    double color[3];
    double ev; /* radiance is color x 2^ev, [0, 1e9] */
} LodestarStop;

typedef struct LodestarKey {
    uint32_t struct_size;
    int32_t interpolation; /* of the gradient: LODESTAR_INTERPOLATION_* */
    int32_t space;         /* LODESTAR_SPACE_* */
    uint32_t stop_count;
    const LodestarStop* stops;
    double hour;
    double tint[3];
    uint32_t has_axis; /* 0: the light's own */
    uint32_t reserved;
    double axis[3];
} LodestarKey;

typedef struct LodestarLightDesc {
    uint32_t struct_size;
    int32_t kind;        /* LODESTAR_SKY, LODESTAR_SUN */
    const char* name;    /* may be null */
    double axis[3];      /* towards the light; zero: up, counted */
    uint32_t has_path;   /* a sun's true path, in place of axes */
    int32_t day_of_year; /* 1 to 366 */
    double latitude;     /* degrees */
    double north[3];
    uint32_t key_count;  /* at least 1 */
    uint32_t key_stride; /* bytes from one key to the next: sizeof(LodestarKey) */
    const LodestarKey* keys;
    uint32_t add; /* a sky: 1 beside the distant environment; 0 in its place, as in documents */
    uint32_t reserved;
} LodestarLightDesc;

/* Where an environment's light comes from. */
enum {
    LODESTAR_LATLONG = 0,  /* pixels; centre column north, rightwards to east, top up; width = 2
                              height */
    LODESTAR_CUBE = 1,     /* pixels of six square faces in OpenGL's order, each below the last */
    LODESTAR_ANALYTIC = 2, /* a text: `constant:1,1,1`, `gradient:0,1`, `disc:...`, `faces:...` */
    LODESTAR_CAPTURED = 3  /* what the host draws for the face jobs of plans: a static probe */
};

typedef struct LodestarEnvironmentDesc {
    uint32_t struct_size;
    int32_t layout;               /* LODESTAR_LATLONG ... */
    const char* name;             /* for the plan's text; may be null */
    const char* analytic;         /* its text */
    const float* pixels;          /* linear Rec. 709 radiance [0, 1e9], row 0 at the top */
    uint32_t width, height;       /* of the pixels */
    uint32_t channels;            /* 3, or 4 of which the last is not read */
    uint32_t face_width;          /* of the cube that is made, texels: 1 to 4096; 0 is 256 */
    double rotation;              /* radians about up, counter-clockwise seen from above */
    double ev;                    /* radiance x 2^ev, [-64, 64] */
    double position[3];           /* where it is captured */
    double near_plane, far_plane; /* of what is captured, 0 < near < far */
    uint32_t in_host_frame; /* 0: what is given stands in a document's frame, as its files do; 1: in
                               the host's, as read_cube's pixels do */
    uint32_t reserved;
} LodestarEnvironmentDesc;

/* One of an environment's two cubes, as a GPU takes it: RGBA, level by level, six faces in OpenGL's
 * order, row by row; width halves from level to level. */
typedef struct LodestarCube {
    uint32_t struct_size;
    uint32_t width; /* of a face of level 0 */
    uint32_t levels;
    uint32_t half_floats;   /* 1: half floats; 0: floats, where halves do not reach */
    double scale;           /* what a stored colour is multiplied by to be radiance */
    uint64_t version;       /* changes when the texels do; 0: a capture that has never been whole */
    uint32_t faces_missing; /* of a capture that is asked for */
    uint32_t reserved;
} LodestarCube;

/* A light at the context's hour. */
typedef struct LodestarLightState {
    uint32_t struct_size;
    int32_t kind;
    double axis[3];    /* unit, towards the light */
    double visibility; /* [0, 1]: below 1 a sun sets; at 0 it costs nothing and has no texels */
    uint64_t version;  /* changes when the texels do */
} LodestarLightState;

/* The texels of a light. */
enum {
    LODESTAR_TEXELS_MAP =
        0, /* columns x rows, LODESTAR_FORMAT_RGB9E5, row 0 first: lodestar_host_rsrm */
    LODESTAR_TEXELS_LAMBERT =
        1, /* a line of lambert_columns RGBA floats: lodestar_host_rsrmLambert */
    LODESTAR_TEXELS_GRADIENT = 2,    /* a line of gradient_columns RGBA half floats, square roots of
                                        what    lodestar_host_rsrmGradient answers */
    LODESTAR_TEXELS_ENVIRONMENT = 3, /* of an environment: a cube with mip levels */
    LODESTAR_TEXELS_IRRADIANCE = 4   /* of an environment: a cube of irradiance over pi */
};

/* The same for all lights of a context: sizes, and the members of GLSL's LodestarRsrm. */
typedef struct LodestarMapLayout {
    uint32_t struct_size;
    int32_t layout_name; /* LodestarRsrm.layoutName */
    uint32_t columns, rows;
    uint32_t lambert_columns, gradient_columns;
    float least_exponent, greatest_exponent;
    float first_octave, rows_per_octave;
    /* 1: a document has given the rows one by one, 2 to 24 of them: lodestar_rsrmOwnRow finds them,
     * and first_octave and rows_per_octave say nothing. */
    uint32_t own_rows, reserved;
    float octaves[24]; /* log2(s + 1) of the rows, four a vector of lodestar_host_rsrmOctaves */
} LodestarMapLayout;

/* A material without textures, in glTF's quantities or, where `given` has a bit, in Blinn-Phong's.
 * With any bit metallic and roughness say nothing: what is not given is the base colour, an F0 of
 * 0.04, exponent 0. Reflectances, metallic and roughness in [0, 1]. */
typedef struct LodestarMaterial {
    uint32_t struct_size;
    uint32_t given; /* LODESTAR_MATERIAL_* */
    double base_color[3];
    double metallic, roughness;
    double diffuse[3]; /* k_L */
    double f0[3];
    double exponent; /* Blinn-Phong, at least 0; above 1e7, and infinite, a mirror */
    /* What is no metal, of metallic and roughness: 0, an F0 of 0.04; else of glTF's ior (at least
     * 1, or 0: an F0 of 1), specular in [0, 1] and specular colour at least 0. */
    uint32_t has_dielectric, reserved;
    double ior, specular, specular_color[3];
} LodestarMaterial;
enum { LODESTAR_MATERIAL_DIFFUSE = 1, LODESTAR_MATERIAL_F0 = 2, LODESTAR_MATERIAL_EXPONENT = 4 };

/* Which GLSL a text is for. */
typedef struct LodestarDialect {
    uint32_t struct_size;
    uint32_t version;              /* 330, 410, 450, or 300 for GLSL ES */
    int32_t profile;               /* LODESTAR_PROFILE_* */
    uint32_t without_version_line; /* for hosts that paste it into a text of theirs */
    uint32_t uniform_block; /* 1: "plugin/lighting.glsl" reads a std140 block, LodestarLighting; 0:
                               plain uniforms */
    uint32_t reserved;
} LodestarDialect;
enum { LODESTAR_PROFILE_CORE = 0, LODESTAR_PROFILE_COMPATIBILITY = 1, LODESTAR_PROFILE_ES = 2 };

/* What "plugin/lighting.glsl" reads. */
enum {
    LODESTAR_UNIFORM_VEC4 = 0, /* `count` of them, a float each 4 bytes, at `offset` of
                                  plan_uniforms and of the block */
    LODESTAR_UNIFORM_CUBE = 1, /* samplerCube */
    LODESTAR_UNIFORM_ARRAY = 2 /* sampler2DArray */
};
typedef struct LodestarUniform {
    uint32_t struct_size;
    int32_t type; /* LODESTAR_UNIFORM_* */
    const char* name;
    uint32_t count;  /* of an array's elements, else 1 */
    uint32_t offset; /* bytes */
    int32_t texels;  /* of a sampler: LODESTAR_TEXELS_* */
    uint32_t reserved;
} LodestarUniform;

/* Something that the host draws. */
typedef struct LodestarDraw {
    uint32_t struct_size;
    uint32_t visible;                 /* 0: outside the view */
    const char* name;                 /* for the plan's text; may be null */
    const LodestarMaterial* material; /* null: it takes no light */
} LodestarDraw;

/* What a plan is made for. */
typedef struct LodestarFrame {
    uint32_t struct_size;
    uint32_t backdrop;                /* 1: lodestar_backdrop is drawn */
    double hour;                      /* as set_hour */
    uint32_t draw_count, draw_stride; /* bytes from one draw to the next: sizeof(LodestarDraw) */
    const LodestarDraw* draws; /* null: the host does not say; whatever could be called for, is */
    uint32_t max_faces;        /* face jobs at most */
    uint32_t reserved;
} LodestarFrame;

/* A light that a frame is lit by, in the order of the uniforms. */
typedef struct LodestarPlannedLight {
    uint32_t struct_size;
    uint32_t layer; /* of the arrays: its place among all lights */
    LodestarLight light;
    double axis[3]; /* unit, towards the light */
    uint64_t version;
    uint32_t blend; /* 1: its texels are new since the plan before */
    uint32_t reserved;
} LodestarPlannedLight;

/* A face of a captured environment that the host is to draw: what stands around its position, but
 * not the object that it is of; the pixels go to environment_face. */
typedef struct LodestarFaceJob {
    uint32_t struct_size;
    int32_t face; /* OpenGL's order */
    LodestarEnvironment environment;
    double view[16];       /* camera from world, column after column */
    double projection[16]; /* OpenGL clip space from camera: row 0 of the face is at y = -1 */
    uint32_t width;        /* of the face, texels */
    uint32_t reserved;
} LodestarFaceJob;

/* Features of a draw in a plan: the macros of "plugin/lighting.glsl". */
enum {
    LODESTAR_FEATURE_ENVIRONMENT = 1, /* LODESTAR_WITH_ENVIRONMENT */
    LODESTAR_FEATURE_LIGHTS = 2,      /* LODESTAR_WITH_LIGHTS */
    LODESTAR_FEATURE_MIRROR = 4,      /* LODESTAR_RSRM_MIRROR */
    LODESTAR_FEATURE_ROWS = 32        /* LODESTAR_RSRM_ROWS */
};

/* Work, planned or done. */
typedef struct LodestarWork {
    uint32_t struct_size;
    uint32_t face_jobs;
    uint64_t uploads, upload_bytes, texels_written;
    uint64_t state_queries; /* of the guard, counted apart; a plan foresees none */
} LodestarWork;

/* The extension "lodestar.gl": the texels as textures of the host's OpenGL context (3.3 or later,
 * any profile). Its functions are [gl], with the context current. Nothing of the host's state
 * is changed: what uploads touch is queried and put back, and errors of the host's are not read.
 * Where a texture of the library's ends, what it was bound to has 0, as OpenGL has it. */
#define LODESTAR_EXTENSION_GL "lodestar.gl"

typedef struct LodestarGlTexture {
    uint32_t struct_size;
    uint32_t target; /* GL_TEXTURE_2D_ARRAY, GL_TEXTURE_CUBE_MAP */
    uint32_t name;   /* the library's: bind it, never delete it; 0 where there is nothing of it */
    uint32_t width, height, layers;
    uint32_t internal_format; /* GL_RGB9_E5, GL_RGBA32F, GL_RGBA16F */
    uint32_t reserved;
} LodestarGlTexture;

typedef struct LodestarGlApi {
    uint32_t struct_size; /* of what this library has */
    uint32_t reserved;
    /* Asks for the functions; [gl] is the caller's thread from here on.
     * LODESTAR_E_UNSUPPORTED: a function is missing, or OpenGL is older than 3.3. */
    LodestarStatus (*attach)(LodestarContext*, void* (*get_procedure)(const char* name));
    /* Deletes the textures; with alive 0 the context is lost and they are forgotten. To be called
     * before context_destroy, which makes no GL call. */
    LodestarStatus (*detach)(LodestarContext*, int32_t alive);
    /* Uploads what a plan shows, light probes too (lodestar_probes.h), and the textures do not hold
     * yet: a frame in which nothing changed makes no GL call. Plans may be left out. Names stay
     * until lights are made or end. */
    LodestarStatus (*execute)(LodestarContext*, LodestarPlan);
    /* A texture as the last executed plan left it. Cubes are made to be read seamlessly: the host
     * enables GL_TEXTURE_CUBE_MAP_SEAMLESS. @param texels LODESTAR_TEXELS_* */
    LodestarStatus (*texture)(LodestarContext*, int32_t texels, LodestarGlTexture*);
    /* Level 0 of a cube texture of the host's as RGBA floats, six faces in OpenGL's order: pixels
     * for environment_create, or a face each for environment_face. A two-call query in bytes; it
     * waits for the GPU. LODESTAR_E_ARG: it is no cube whose faces have level 0. */
    LodestarStatus (*read_cube)(LodestarContext*, uint32_t name, float* rgba, size_t* size);
    /* With resets 1 the functions query nothing of the host's state, which the host sets anew:
     * where one uploads or reads, it leaves 0 bound to GL_TEXTURE_2D_ARRAY and GL_TEXTURE_CUBE_MAP
     * of the active unit and to GL_PIXEL_UNPACK_BUFFER and GL_PIXEL_PACK_BUFFER, and GL_UNPACK_*
     * and GL_PACK_* at OpenGL's initial values. 0 after each attach. */
    LodestarStatus (*set_host_resets)(LodestarContext*, int32_t resets);
    /* What has been done since attach. */
    LodestarStatus (*work)(LodestarContext*, LodestarWork*);
} LodestarGlApi;

typedef struct LodestarApi {
    uint32_t struct_size; /* in: of the host's; out: of what was filled */
    uint32_t abi_version; /* out: the library's */

    /* [any] Makes a context; its thread is the caller's. The host is copied, its user kept. */
    LodestarStatus (*context_create)(const LodestarHost* host, LodestarContext** context);
    /* [main] Ends it with all lights and documents. Null is nothing. */
    LodestarStatus (*context_destroy)(LodestarContext* context);
    /* What the last failed [main] or, on its thread, [gl] call of this context said; "" after none.
     * Valid until the next call. Of a null context: what context_create said last on this thread.
     */
    const char* (*last_error)(LodestarContext* context);

    /* [main] Lights. Values out of range are repaired and logged, as a document's are. */
    LodestarStatus (*light_create)(LodestarContext*, const LodestarLightDesc*, LodestarLight*);
    LodestarStatus (*light_update)(LodestarContext*, LodestarLight, const LodestarLightDesc*);
    LodestarStatus (*light_destroy)(LodestarContext*, LodestarLight);
    /* [main] All lights, in the order of their making: a two-call query, count for size. */
    LodestarStatus (*lights)(LodestarContext*, LodestarLight* handles, size_t* count);

    /* [main] Reads a lighting document (*.lodestar.json). Nothing of the context changes yet. */
    LodestarStatus (*document_load)(LodestarContext*, const char* utf8, size_t size,
                                    LodestarDocument*);
    /* [main] Replaces all lights by the document's; lights made from then on have its maps' rows.
     */
    LodestarStatus (*document_apply)(LodestarContext*, LodestarDocument);
    LodestarStatus (*document_destroy)(LodestarContext*, LodestarDocument);

    /* [main] The hour of the day, finite; wrapped into [0, 24). 15 at first. */
    LodestarStatus (*set_hour)(LodestarContext*, double hour);
    LodestarStatus (*light_state)(LodestarContext*, LodestarLight, LodestarLightState*);
    /* [main] A light's texels at the hour: a two-call query in bytes. */
    LodestarStatus (*light_texels)(LodestarContext*, LodestarLight, int32_t which, void* buffer,
                                   size_t* size);
    /* [any] Without a document's own rows: a new context's. context_map_layout has those of one. */
    LodestarStatus (*map_layout)(LodestarMapLayout*);

    /* [main] What a shader would get of the environment and the lights: radiance about a direction
     * over the Phong lobe of an exponent ([0, 1e7] or infinity), and over Lambert's lobe about a
     * normal. */
    LodestarStatus (*radiance)(LodestarContext*, const double direction[3], double exponent,
                               double rgb[3]);
    LodestarStatus (*lambert)(LodestarContext*, const double normal[3], double rgb[3]);

    /* [any] A file of the shading text with its includes in place: "plugin/lighting.glsl" is all
     * of it with bindings, "lodestar/rsrm.glsl" and the like are functions alone. A
     * two-call query in bytes, the closing 0 included. LODESTAR_E_UNSUPPORTED: no such file or
     * dialect. */
    LodestarStatus (*glsl_text)(const char* file, const LodestarDialect*, char* buffer,
                                size_t* size);
    /* [any] An interface that this version has no member for, by its id; null if there is none. */
    const void* (*get_extension)(const char* id);

    /* [main] Sets what the document says of a material, by its name in glTF or "#index", over the
     * host's, and the bits of it; a material that it does not name stays. One of metallic and
     * roughness keeps what they make of the numbers that the document does not give, and gets all
     * bits. A host asks by number, then by name. */
    LodestarStatus (*document_material)(LodestarContext*, LodestarDocument, const char* name,
                                        LodestarMaterial*);
    /* [any] Two vec4 of uniform data, GLSL's LodestarSurface: diffuse, exponent; f0, 1.
     * LODESTAR_E_ARG: a value is out of range; nothing is written. */
    LodestarStatus (*material_pack)(const LodestarMaterial*, float packed[8]);

    /* [main] Environments. Radiance out of range is repaired and logged. */
    LodestarStatus (*environment_create)(LodestarContext*, const LodestarEnvironmentDesc*,
                                         LodestarEnvironment*);
    LodestarStatus (*environment_destroy)(LodestarContext*, LodestarEnvironment);
    /* [main] Which is the distant one; 0: none. A sky light stands in its place unless it is added.
     */
    LodestarStatus (*set_environment)(LodestarContext*, LodestarEnvironment);
    /* [main] A face of a captured one, face_width^2 pixels of 3 or 4 channels, as its job says.
     * Once no face is missing, all six show at once. */
    LodestarStatus (*environment_face)(LodestarContext*, LodestarEnvironment, int32_t face,
                                       const float* pixels, uint32_t channels);
    /* [main] Asks for a captured one anew: what it shows stays until all faces are in. */
    LodestarStatus (*environment_request)(LodestarContext*, LodestarEnvironment);
    /* [main] @param texels LODESTAR_TEXELS_ENVIRONMENT, _IRRADIANCE */
    LodestarStatus (*environment_cube)(LodestarContext*, LodestarEnvironment, int32_t texels,
                                       LodestarCube*);
    /* [main] A two-call query in bytes. */
    LodestarStatus (*environment_texels)(LodestarContext*, LodestarEnvironment, int32_t texels,
                                         uint32_t level, void* buffer, size_t* size);
    /* [main] A document's environment: a file that the host reads, relative to the document, or an
     * analytic text (it has a colon). A two-call query in bytes, the closing 0 included; *size is 0
     * where the document names none. */
    LodestarStatus (*document_environment)(LodestarContext*, LodestarDocument, char* source,
                                           size_t* size, double* rotation, double* ev);

    /* [main] Decides a frame, and makes on the CPU what it asks for. A plan supposes that the plans
     * before it were executed. */
    LodestarStatus (*plan_make)(LodestarContext*, const LodestarFrame*, LodestarPlan*);
    /* [any] A plan in words, a line an effect: a two-call query in bytes, the closing 0 included.
     */
    LodestarStatus (*plan_text)(LodestarContext*, LodestarPlan, char* buffer, size_t* size);
    /* [any] Two-call queries, count for size. plan_features answers LODESTAR_FEATURE_* for each
     * draw of the frame, 0 for those outside the view. */
    LodestarStatus (*plan_lights)(LodestarContext*, LodestarPlan, LodestarPlannedLight*,
                                  size_t* count);
    LodestarStatus (*plan_jobs)(LodestarContext*, LodestarPlan, LodestarFaceJob*, size_t* count);
    LodestarStatus (*plan_features)(LodestarContext*, LodestarPlan, uint32_t*, size_t* count);
    /* [any] Whose texels, LODESTAR_TEXELS_ENVIRONMENT or _IRRADIANCE, the frame reads; 0: nobody's.
     */
    LodestarStatus (*plan_environment)(LodestarContext*, LodestarPlan, int32_t texels,
                                       LodestarEnvironment*);
    /* [any] The data of the uniforms, as LodestarUniform says: a two-call query in bytes. */
    LodestarStatus (*plan_uniforms)(LodestarContext*, LodestarPlan, void* buffer, size_t* size);
    /* [any] What executing it is expected to do. */
    LodestarStatus (*plan_work)(LodestarContext*, LodestarPlan, LodestarWork*);
    /* [any] What "plugin/lighting.glsl" reads, from index 0 on; LODESTAR_E_ARG: there is no more.
     */
    LodestarStatus (*uniform_info)(uint32_t index, LodestarUniform*);
    /* [main] How the lights' maps are laid out: document_apply may change it. */
    LodestarStatus (*context_map_layout)(LodestarContext*, LodestarMapLayout*);
} LodestarApi;

/* [any] The only symbol. Fills the host's table as far as struct_size reaches.
 * LODESTAR_E_ABI: another major version, or a table too small for the first two members. */
LODESTAR_EXPORT LodestarStatus lodestar_get_api(uint32_t host_abi, LodestarApi* api);

#ifdef __cplusplus
}
#endif
#endif
