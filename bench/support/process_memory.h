// Memory of this process, as the system counts it.
#pragma once

namespace dvrlab::bench {

double resident_bytes();
double peak_bytes();  // the most that was resident so far

}  // namespace dvrlab::bench
