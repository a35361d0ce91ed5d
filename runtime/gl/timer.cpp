// SPDX-License-Identifier: MIT
#include "gl/timer.h"

#include <epoxy/gl.h>

namespace lodestar::gl {

Timer::Timer(Device& device) {
    if (!device.capabilities().software) {
        glGenQueries(1, &id_);
    }
}

Timer::~Timer() {
    if (id_ != 0) {
        glDeleteQueries(1, &id_);
    }
}

void Timer::begin() {
    if (id_ != 0) {
        glBeginQuery(GL_TIME_ELAPSED, id_);
        return;
    }
    glFinish();
    begun_ = Clock::now();
}

void Timer::end() {
    if (id_ != 0) {
        glEndQuery(GL_TIME_ELAPSED);
        return;
    }
    glFinish();
    ended_ = Clock::now();
}

double Timer::milliseconds() const {
    if (id_ == 0) {
        return std::chrono::duration<double, std::milli>(ended_ - begun_).count();
    }
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(id_, GL_QUERY_RESULT, &nanoseconds);
    return static_cast<double>(nanoseconds) * 1e-6;
}

bool Timer::isReady() const {
    if (id_ == 0) {
        return true;
    }
    GLint ready = 0;
    glGetQueryObjectiv(id_, GL_QUERY_RESULT_AVAILABLE, &ready);
    return ready != 0;
}

} // namespace lodestar::gl
