// SPDX-License-Identifier: MIT
#include "gl/timer.h"

#include <epoxy/gl.h>

namespace lodestar::gl {

Timer::Timer(Device&) {
    glGenQueries(1, &id_);
}

Timer::~Timer() {
    glDeleteQueries(1, &id_);
}

void Timer::begin() {
    glBeginQuery(GL_TIME_ELAPSED, id_);
}

void Timer::end() {
    glEndQuery(GL_TIME_ELAPSED);
}

double Timer::milliseconds() const {
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(id_, GL_QUERY_RESULT, &nanoseconds);
    return static_cast<double>(nanoseconds) * 1e-6;
}

bool Timer::isReady() const {
    GLint ready = 0;
    glGetQueryObjectiv(id_, GL_QUERY_RESULT_AVAILABLE, &ready);
    return ready != 0;
}

} // namespace lodestar::gl
