// The slope in ODE: rigid boxes, the iterative solver (quick step), contact joints with a friction pyramid.

#include <ode/ode.h>

#include <vector>

#include "slope.h"

namespace {

class World {
 public:
    explicit World(const peers::Settings& settings)
        : time_step_(settings.time_step),
          world_(dWorldCreate()),
          space_(dHashSpaceCreate(nullptr)),
          contacts_(dJointGroupCreate(0)) {
        dWorldSetQuickStepNumIterations(world_, settings.iterations);
        dCreatePlane(space_, 0, 0, 1, 0);
        for (int b = 0; b < peers::kBlocks; ++b) {
            double c[3];
            peers::centreOf(b, c);
            dBodyID body = dBodyCreate(world_);
            dMass mass;
            dMassSetBox(&mass, peers::kDensity, peers::kSize[0], peers::kSize[1], peers::kSize[2]);
            dBodySetMass(body, &mass);
            dBodySetPosition(body, c[0], c[1], c[2]);
            dGeomSetBody(dCreateBox(space_, peers::kSize[0], peers::kSize[1], peers::kSize[2]), body);
            bodies_.push_back(body);
        }
    }
    ~World() {
        dJointGroupDestroy(contacts_);
        dSpaceDestroy(space_);
        dWorldDestroy(world_);
    }
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    void setGravity(double x, double z) { dWorldSetGravity(world_, x, 0, z); }
    void step() {
        dSpaceCollide(space_, this, collide);
        dWorldQuickStep(world_, time_step_);
        dJointGroupEmpty(contacts_);
    }
    void position(int block, double to[3]) const {
        const dReal* p = dBodyGetPosition(bodies_[block]);
        for (int k = 0; k < 3; ++k) to[k] = p[k];
    }

 private:
    static void collide(void* data, dGeomID a, dGeomID b) {
        constexpr int kMost = 8;
        auto& self = *static_cast<World*>(data);
        dContact contact[kMost]{};
        const int n = dCollide(a, b, kMost, &contact[0].geom, sizeof(dContact));
        for (int k = 0; k < n; ++k) {
            contact[k].surface.mode = dContactApprox1;
            contact[k].surface.mu = std::tan(peers::kFriction);
            const dJointID joint = dJointCreateContact(self.world_, self.contacts_, &contact[k]);
            dJointAttach(joint, dGeomGetBody(a), dGeomGetBody(b));
        }
    }

    double time_step_;
    dWorldID world_;
    dSpaceID space_;
    dJointGroupID contacts_;
    std::vector<dBodyID> bodies_;
};

}  // namespace

int main(int argc, char** argv) {
    dInitODE();
    const int code = peers::search<World>("ODE", argc, argv);
    dCloseODE();
    return code;
}
