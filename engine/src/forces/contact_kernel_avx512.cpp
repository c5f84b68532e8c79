#include "forces/contact_kernel.h"
#include "forces/contact_members.h"

namespace talus {

void updateContactsAvx512(const ContactView& view, std::size_t begin, std::size_t end) {
    updateGroups<Lanes>(view, begin, end);
}

}  // namespace talus
