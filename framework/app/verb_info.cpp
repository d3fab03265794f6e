#include "framework/app/verbs.h"
namespace dvrlab {
int info_verb(const Options&) { return 0; }
}  // namespace dvrlab
