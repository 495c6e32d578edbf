// What a user sees while a run goes on, on standard error.
#pragma once

#include "options.h"

#include <functional>
#include <string>

namespace mpipov {

class ProgressView {
  public:
    // `automatic` is a live line where standard error is a terminal.
    explicit ProgressView(ProgressStyle style);
    ~ProgressView();
    ProgressView(const ProgressView&) = delete;
    ProgressView& operator=(const ProgressView&) = delete;

    // fraction: 0 to 1 of the pixels; seconds since the run began.
    void update(double fraction, int sections_done, int sections, double seconds);
    // From when on the time that is left is reckoned; else the run's beginning.
    void begin_image(double seconds) { began_ = seconds; }
    // Before the sections: `wave` of `waves` gathers radiosity samples, from 1.
    void update_gathering(int wave, int waves, double fraction, double seconds);
    // All is rendered.
    void finish(int sections, double seconds);
    // A line of its own, above the live one. What is no progress (POV-Ray's warnings, what the user
    // should know of the plan) is said on `none` too.
    void say(const std::string& line);
    // The same, but for `none`.
    void inform(const std::string& line);

  private:
    static void print(const std::string& text);
    void show(double fraction, double seconds, const std::function<std::string()>& line);
    void clear();

    ProgressStyle style_;
    bool live_ = false, shown_ = false;
    double last_update_ = -1e9, last_fraction_ = -1, began_ = 0;
};

// "43 %, 7 of 16 sections, 12 s left"
std::string progress_line(double fraction, int sections_done, int sections, double seconds);

}  // namespace mpipov
