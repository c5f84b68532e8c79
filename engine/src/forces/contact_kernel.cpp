#include "forces/contact_kernel.h"

namespace talus {

void updateContactsScalar(const ContactView& view, std::size_t begin, std::size_t end) {
    updateGroups<double>(view, begin, end);
}

}  // namespace talus
