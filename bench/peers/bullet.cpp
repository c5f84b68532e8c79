// The slope in Bullet: rigid boxes, sequential impulses. Lengths are ten times as long, gravity too, because
// Bullet's own thresholds are made for blocks of about a metre.

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "slope.h"

namespace {

constexpr double kScale = 10;

class World {
 public:
    explicit World(const peers::Settings& settings)
        : time_step_(settings.time_step),
          dispatcher_(&configuration_),
          world_(&dispatcher_, &broadphase_, &solver_, &configuration_),
          box_(btVector3(0.5 * kScale * peers::kSize[0], 0.5 * kScale * peers::kSize[1],
                         0.5 * kScale * peers::kSize[2])),
          floor_(btVector3(100, 100, 5)) {
        world_.getSolverInfo().m_numIterations = settings.iterations;
        // With one friction direction, the default, the columns fan out at half the angle.
        world_.getSolverInfo().m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
        add(floor_, 0, btVector3(0, 0, -5));
        const double volume = peers::kSize[0] * peers::kSize[1] * peers::kSize[2];
        for (int b = 0; b < peers::kBlocks; ++b) {
            double c[3];
            peers::centreOf(b, c);
            add(box_, peers::kDensity * volume, kScale * btVector3(c[0], c[1], c[2]));
        }
    }
    ~World() {
        for (const auto& body : bodies_) world_.removeRigidBody(body.get());
    }
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    void setGravity(double x, double z) {
        for (const auto& body : bodies_) body->setGravity(kScale * btVector3(x, 0, z));
    }
    void step() { world_.stepSimulation(time_step_, 0); }
    void position(int block, double to[3]) const {
        const btVector3& p = bodies_[block + 1]->getWorldTransform().getOrigin();
        for (int k = 0; k < 3; ++k) to[k] = p[k] / kScale;
    }

 private:
    /// Bullet multiplies the friction coefficients of the two bodies.
    void add(btCollisionShape& shape, double mass, const btVector3& centre) {
        btVector3 inertia(0, 0, 0);
        if (mass > 0) shape.calculateLocalInertia(mass, inertia);
        states_.push_back(
            std::make_unique<btDefaultMotionState>(btTransform(btQuaternion::getIdentity(), centre)));
        bodies_.push_back(std::make_unique<btRigidBody>(
            btRigidBody::btRigidBodyConstructionInfo(mass, states_.back().get(), &shape, inertia)));
        bodies_.back()->setFriction(std::sqrt(std::tan(peers::kFriction)));
        bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
        world_.addRigidBody(bodies_.back().get());
    }

    double time_step_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_;
    btBoxShape box_, floor_;
    std::vector<std::unique_ptr<btDefaultMotionState>> states_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

}  // namespace

int main(int argc, char** argv) { return peers::search<World>("Bullet", argc, argv); }
