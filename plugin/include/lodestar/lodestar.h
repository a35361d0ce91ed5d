/* SPDX-License-Identifier: MIT
 *
 * Lodestar's C interface: painted skies and suns (radially symmetric reflection maps) for a host
 * that has its own renderer. C11; no GL header, nothing of C++ crosses it.
 *
 * How a host begins:
 *     LodestarApi api = {.struct_size = sizeof api};
 *     if (lodestar_get_api(LODESTAR_ABI_VERSION, &api) != LODESTAR_OK) ...
 *     LodestarContext *context;
 *     api.context_create(&host, &context);
 *     api.document_load(context, text, size, &document);   // what an artist saved, or light_create
 *     api.document_apply(context, document);
 *     every frame: api.set_hour(context, hour), then for each light light_state, and light_texels
 *     where `version` has changed; the shading text is api.glsl_text.
 *
 * What it does not do: it makes no window, opens no file, starts no thread, loads no scene and
 * captures no probe. It makes no GL call but in the extension "lodestar.gl". The host draws.
 *
 * Rules
 * - Every struct that a host fills begins with struct_size = sizeof of it: members that a host's
 * header did not have yet are taken as 0, those that this library does not know must be 0.
 * - Threads: [main] functions of a context are called on the thread that created it, one at a time;
 *   [any] functions on any thread.
 * - Ownership: what a host passes is copied; what it gets by two-call queries is its own. In a
 *   two-call query `*size` is set to what is needed, and LODESTAR_MORE says that the buffer was
 * null or smaller; nothing is written then.
 * - Errors are statuses; last_error says the same in words. Memory that runs out gives
 *   LODESTAR_E_NOMEM and leaves everything as it was.
 * - Text is UTF-8. Vectors are right-handed; a sky's axis is up, axes point towards the light,
 * colours are linear Rec. 709, hours local solar time in [0, 24).
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
    LODESTAR_E_THREAD = -6,      /* a [main] function on another thread */
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

/* What a host gives. All functions may be null. */
typedef struct LodestarHost {
    uint32_t struct_size;
    uint32_t reserved;
    void* user; /* passed back to every function */
    /* Both or none; alignment 16. Called on the thread of the call that needs memory. */
    void* (*allocate)(void* user, size_t size);
    void (*release)(void* user, void* memory);
    void (*log)(void* user, int32_t number, const char* utf8);
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
    double axis[3];      /* towards the light; zero: +Y, counted */
    uint32_t has_path;   /* a sun's true path, in place of axes */
    int32_t day_of_year; /* 1 to 366 */
    double latitude;     /* degrees */
    double north[3];
    uint32_t key_count;  /* at least 1 */
    uint32_t key_stride; /* bytes from one key to the next: sizeof(LodestarKey) */
    const LodestarKey* keys;
} LodestarLightDesc;

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
    LODESTAR_TEXELS_GRADIENT =
        2 /* a line of gradient_columns RGBA floats: lodestar_host_rsrmGradient */
};

/* The same for all lights: sizes, and the members of GLSL's LodestarRsrm. */
typedef struct LodestarMapLayout {
    uint32_t struct_size;
    int32_t layout_name; /* LodestarRsrm.layoutName */
    uint32_t columns, rows;
    uint32_t lambert_columns, gradient_columns;
    float least_exponent, greatest_exponent;
    float first_octave, rows_per_octave;
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
} LodestarMaterial;
enum { LODESTAR_MATERIAL_DIFFUSE = 1, LODESTAR_MATERIAL_F0 = 2, LODESTAR_MATERIAL_EXPONENT = 4 };

/* Which GLSL a text is for. */
typedef struct LodestarDialect {
    uint32_t struct_size;
    uint32_t version;              /* 330, 410, 450, or 300 for GLSL ES */
    int32_t profile;               /* LODESTAR_PROFILE_* */
    uint32_t without_version_line; /* for hosts that paste it into a text of theirs */
} LodestarDialect;
enum { LODESTAR_PROFILE_CORE = 0, LODESTAR_PROFILE_COMPATIBILITY = 1, LODESTAR_PROFILE_ES = 2 };

/* The extension "lodestar.gl": the texels as textures of the host's OpenGL context (3.3 or later,
 * any profile). Its functions are [main] too, with the context current. Nothing of the host's state
 * is changed: what uploads touch is queried and put back, and errors of the host's are not read.
 * Where a texture of the library's ends, what it was bound to has 0, as OpenGL has it. */
#define LODESTAR_EXTENSION_GL "lodestar.gl"

typedef struct LodestarGlTexture {
    uint32_t struct_size;
    uint32_t target; /* GL_TEXTURE_2D_ARRAY */
    uint32_t name;   /* the library's: bind it, never delete it; 0 where there are no lights */
    uint32_t width, height, layers;
    uint32_t internal_format; /* GL_RGB9_E5, GL_RGBA32F */
    uint32_t reserved;
} LodestarGlTexture;

typedef struct LodestarGlApi {
    uint32_t struct_size; /* of what this library has */
    uint32_t reserved;
    /* Asks for the functions. LODESTAR_E_UNSUPPORTED: one is missing, or OpenGL is older than 3.3.
     */
    LodestarStatus (*attach)(LodestarContext*, void* (*get_procedure)(const char* name));
    /* Deletes the textures; with alive 0 the context is lost and they are forgotten. To be called
     * before context_destroy, which makes no GL call. */
    LodestarStatus (*detach)(LodestarContext*, int32_t alive);
    /* Uploads what has changed at the hour: a frame in which nothing did makes no GL call. Names
     * stay until lights are made or end. */
    LodestarStatus (*update)(LodestarContext*);
    LodestarStatus (*texture)(LodestarContext*, int32_t which, LodestarGlTexture*);
    /* The layer of a light in all three; LODESTAR_E_ARG: it has not been uploaded. */
    LodestarStatus (*layer)(LodestarContext*, LodestarLight, uint32_t* layer);
    /* With resets 1 `update` queries nothing of the host's state, which the host sets anew: where
     * it uploads, it leaves 0 bound to GL_TEXTURE_2D_ARRAY of the active unit and to
     * GL_PIXEL_UNPACK_BUFFER, and GL_UNPACK_* at OpenGL's initial values. 0 after each attach. */
    LodestarStatus (*set_host_resets)(LodestarContext*, int32_t resets);
} LodestarGlApi;

typedef struct LodestarApi {
    uint32_t struct_size; /* in: of the host's; out: of what was filled */
    uint32_t abi_version; /* out: the library's */

    /* [any] Makes a context; its thread is the caller's. The host is copied, its user kept. */
    LodestarStatus (*context_create)(const LodestarHost* host, LodestarContext** context);
    /* [main] Ends it with all lights and documents. Null is nothing. */
    LodestarStatus (*context_destroy)(LodestarContext* context);
    /* [main] What the last failed call of this context said; "" after none. Valid until the next
     * call. Of a null context: what context_create said last on this thread. */
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
    /* [main] Replaces all lights by the document's. */
    LodestarStatus (*document_apply)(LodestarContext*, LodestarDocument);
    LodestarStatus (*document_destroy)(LodestarContext*, LodestarDocument);

    /* [main] The hour of the day, finite; wrapped into [0, 24). 15 at first. */
    LodestarStatus (*set_hour)(LodestarContext*, double hour);
    LodestarStatus (*light_state)(LodestarContext*, LodestarLight, LodestarLightState*);
    /* [main] A light's texels at the hour: a two-call query in bytes. */
    LodestarStatus (*light_texels)(LodestarContext*, LodestarLight, int32_t which, void* buffer,
                                   size_t* size);
    /* [any] */
    LodestarStatus (*map_layout)(LodestarMapLayout*);

    /* [main] What a shader would get, summed over the lights: radiance about a unit direction over
     * the Phong lobe of an exponent ([0, 1e7] or infinity), and over Lambert's lobe about a normal.
     */
    LodestarStatus (*radiance)(LodestarContext*, const double direction[3], double exponent,
                               double rgb[3]);
    LodestarStatus (*lambert)(LodestarContext*, const double normal[3], double rgb[3]);

    /* [any] A file of the shading text with its includes in place, e.g. "lodestar/rsrm.glsl": a
     * two-call query in bytes, the closing 0 included. LODESTAR_E_UNSUPPORTED: no such file or
     * dialect. */
    LodestarStatus (*glsl_text)(const char* file, const LodestarDialect*, char* buffer,
                                size_t* size);
    /* [any] An interface that this version has no member for, by its id; null if there is none. */
    const void* (*get_extension)(const char* id);

    /* [main] Sets what the document says of a material, by its name in glTF or "#index", over the
     * host's, and the bits of it; a material that it does not name stays. A host asks by number,
     * then by name. */
    LodestarStatus (*document_material)(LodestarContext*, LodestarDocument, const char* name,
                                        LodestarMaterial*);
    /* [any] Two vec4 of uniform data, GLSL's LodestarSurface: diffuse, exponent; f0, 1.
     * LODESTAR_E_ARG: a value is out of range; nothing is written. */
    LodestarStatus (*material_pack)(const LodestarMaterial*, float packed[8]);
} LodestarApi;

/* [any] The only symbol. Fills the host's table as far as struct_size reaches.
 * LODESTAR_E_ABI: another major version, or a table too small for the first two members. */
LODESTAR_EXPORT LodestarStatus lodestar_get_api(uint32_t host_abi, LodestarApi* api);

#ifdef __cplusplus
}
#endif
#endif
