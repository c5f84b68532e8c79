// A model without a history: its faults and doubts as a history would find them.

#include "build/wet_joints.h"
#include "checks/plausible.h"
#include "state/incidence.h"
#include "talus/parallel.h"
#include "talus/simulation.h"

namespace talus {

std::vector<Error> checkModel(const Model& model, const Control& control, ModelCheck* found) {
    return inArena(control.threads, [&]() {
        const bool threads = control.threads != 1;
        const Result<State> built = buildWithWetJoints(model, threads, control);
        if (!built) return built.errors();
        if (found) {
            const ContactCount contacts = countContacts(built->interfaces);
            *found = {checks::doubtsOfHistory(*built, threads), contacts.interfaces, contacts.points,
                      built->interfaces.size() - contacts.interfaces};
        }
        return checks::implausible(*built);
    });
}

}  // namespace talus
