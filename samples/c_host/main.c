/* SPDX-License-Identifier: MIT
 *
 * lodestar-c-host: what a host in plain C does, without OpenGL. It loads a lighting document (or paints a
 * sky itself), walks through a day and prints what a surface facing up receives and how much a renderer
 * would upload, and says the last frame's plan in words.
 */
#include <lodestar/lodestar.h>

#include <stdio.h>
#include <stdlib.h>

static void log_line(void *user, int32_t number, const char *utf8) {
    (void)user;
    fprintf(stderr, "lodestar-c-host: %d: %s\n", (int)number, utf8);
}

static char *read_whole(const char *path, size_t *size) {
    FILE *file = fopen(path, "rb");
    char *text = NULL;
    long length = 0;
    if (file == NULL) {
        return NULL;
    }
    if (fseek(file, 0, SEEK_END) == 0 && (length = ftell(file)) >= 0 && fseek(file, 0, SEEK_SET) == 0) {
        text = malloc((size_t)length + 1);
        *size = text != NULL ? fread(text, 1, (size_t)length, file) : 0;
    }
    fclose(file);
    return text;
}

/* A sky that is blue above and pale at the horizon, painted at one hour: it holds all day. */
static LodestarStatus paint_sky(const LodestarApi *api, LodestarContext *context) {
    const LodestarStop stops[] = {{90, {0.1, 0.25, 0.6}, 0}, {0, {0.9, 0.9, 0.8}, 0}, {-90, {0.2, 0.2, 0.2}, 0}};
    const LodestarKey key = {.struct_size = sizeof key,
                             .stops = stops,
                             .stop_count = sizeof stops / sizeof stops[0],
                             .hour = 12,
                             .tint = {1, 1, 1}};
    const LodestarLightDesc desc = {.struct_size = sizeof desc,
                                    .kind = LODESTAR_SKY,
                                    .name = "painted",
                                    .axis = {0, 1, 0},
                                    .key_count = 1,
                                    .key_stride = sizeof key,
                                    .keys = &key};
    LodestarLight light = 0;
    return api->light_create(context, &desc, &light);
}

static LodestarStatus load(const LodestarApi *api, LodestarContext *context, const char *path) {
    size_t size = 0;
    char *text = read_whole(path, &size);
    LodestarDocument document = 0;
    LodestarStatus status = LODESTAR_E_ARG;
    if (text == NULL) {
        fprintf(stderr, "lodestar-c-host: %s: cannot be read\n", path);
        return status;
    }
    status = api->document_load(context, text, size, &document);
    free(text);
    return status == LODESTAR_OK ? api->document_apply(context, document) : status;
}

static LodestarStatus say(const LodestarApi *api, LodestarContext *context, LodestarPlan plan) {
    char text[4096];
    size_t size = sizeof text;
    const LodestarStatus status = api->plan_text(context, plan, text, &size);
    if (status == LODESTAR_OK) {
        fputs(text, stdout);
    }
    return status;
}

static LodestarStatus walk(const LodestarApi *api, LodestarContext *context) {
    const double up[3] = {0, 1, 0};
    LodestarPlan plan = 0;
    for (int hour = 0; hour < 24; hour += 3) {
        const LodestarFrame frame = {.struct_size = sizeof frame, .hour = hour};
        LodestarWork work = {.struct_size = sizeof work};
        double rgb[3] = {0, 0, 0};
        LodestarStatus status = api->plan_make(context, &frame, &plan);
        if (status == LODESTAR_OK) {
            status = api->plan_work(context, plan, &work);
        }
        if (status == LODESTAR_OK) {
            status = api->lambert(context, up, rgb);
        }
        if (status != LODESTAR_OK) {
            return status;
        }
        printf("%02d:00  %.4f %.4f %.4f  %lu bytes\n", hour, rgb[0], rgb[1], rgb[2], (unsigned long)work.upload_bytes);
    }
    return say(api, context, plan);
}

int main(int argc, char **argv) {
    LodestarApi api = {.struct_size = sizeof api};
    const LodestarHost host = {.struct_size = sizeof host, .log = log_line};
    LodestarContext *context = NULL;
    LodestarStatus status = lodestar_get_api(LODESTAR_ABI_VERSION, &api);
    if (status == LODESTAR_OK) {
        status = api.context_create(&host, &context);
    }
    if (status == LODESTAR_OK) {
        status = argc > 1 ? load(&api, context, argv[1]) : paint_sky(&api, context);
    }
    if (status == LODESTAR_OK) {
        status = walk(&api, context);
    }
    if (context != NULL) {
        api.context_destroy(context);
    }
    return status == LODESTAR_OK ? 0 : 3;
}
