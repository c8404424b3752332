// SPDX-License-Identifier: GPL-2.0-or-later
// The same wall of rigid boxes in Bullet: dry, at rest under its weight on a fixed box, with the steps and iterations that keep such a wall standing.
//
//     bulletBoxes COLUMNS COURSES SECONDS      SECONDS of steps, after some that do not count; one line of JSON
#include <btBulletDynamicsCommon.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <vector>

namespace {

constexpr double side = .2, density = 1800, gravity = 9.8, frictionAngle = 32 * 3.14159265358979 / 180;
constexpr double step       = 1. / 240;
constexpr int    iterations = 50, warmSteps = 200;

double cpuSeconds() { return double(std::clock()) / CLOCKS_PER_SEC; }
double wallSeconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// A box and its motion, which Bullet refers to but does not own.
struct Box {
	btBoxShape           shape;
	btDefaultMotionState motion;
	btRigidBody          body;

	Box(const btVector3& size, const btVector3& centre, double mass)
	        : shape(size / 2)
	        , motion(btTransform(btQuaternion::getIdentity(), centre))
	        , body(mass, &motion, &shape, inertia(size, mass))
	{
		shape.setMargin(.002);                                // of collision, inside the box [m]
		body.setFriction(std::sqrt(std::tan(frictionAngle))); // of a pair: the product
		body.setRestitution(0);
		body.setActivationState(DISABLE_DEACTIVATION); // bodies at rest would not be computed
	}
	static btVector3 inertia(const btVector3& size, double mass)
	{
		const btVector3 s = size * size;
		return btVector3(s.y() + s.z(), s.x() + s.z(), s.x() + s.y()) * mass / 12;
	}
};

struct World {
	btDefaultCollisionConfiguration     configuration;
	btCollisionDispatcher               dispatcher { &configuration };
	btDbvtBroadphase                    broadphase;
	btSequentialImpulseConstraintSolver solver;
	btDiscreteDynamicsWorld             world { &dispatcher, &broadphase, &solver, &configuration };
	std::vector<std::unique_ptr<Box>>   boxes;

	World(int columns, int courses)
	{
		world.setGravity(btVector3(0, 0, -gravity));
		world.getSolverInfo().m_numIterations = iterations;
		const double mass                     = density * side * side * side;
		for (int course = 0; course < courses; ++course)
			for (int column = 0; column < columns; ++column)
				add(btVector3(side, side, side), btVector3((column + .5) * side, 0, (course + .5) * side), mass);
		add(btVector3(columns * side + 1, 1, side), btVector3(columns * side / 2, 0, -side / 2), 0);
	}
	~World()
	{
		for (const auto& box : boxes)
			world.removeRigidBody(&box->body);
	}
	void add(const btVector3& size, const btVector3& centre, double mass)
	{
		boxes.push_back(std::make_unique<Box>(size, centre, mass));
		world.addRigidBody(&boxes.back()->body);
	}
	void run(int steps)
	{
		for (int i = 0; i < steps; ++i)
			world.stepSimulation(step, 0);
	}
	/// How far the lowest box that should be in the top course has come down [m].
	double sunk(int columns, int courses) const
	{
		double most = 0;
		for (int column = 0; column < columns; ++column)
			most = std::fmax(most, (courses - .5) * side - boxes[(courses - 1) * columns + column]->body.getCenterOfMassPosition().z());
		return most;
	}
};

} // namespace

int main(int argc, char** argv)
{
	if (argc != 4) {
		std::fprintf(stderr, "usage: bulletBoxes COLUMNS COURSES SECONDS\n");
		return 2;
	}
	const int    columns = std::atoi(argv[1]), courses = std::atoi(argv[2]);
	const double seconds = std::atof(argv[3]);
	World        wall(columns, courses);
	wall.run(warmSteps);
	int          steps = 0;
	const double cpu = cpuSeconds(), begun = wallSeconds();
	while (wallSeconds() - begun < seconds)
		wall.run(10), steps += 10;
	const double cpuSpent = cpuSeconds() - cpu, wallSpent = wallSeconds() - begun;
	if (wall.sunk(columns, courses) > side / 2) {
		std::fprintf(stderr, "bulletBoxes: the wall has not stood\n");
		return 1;
	}
	std::printf(
	        "{\"bricks\": %d, \"steps\": %d, \"dt\": %.9g, \"simulated\": %.9g, \"cpu\": %.9g, \"wall\": %.9g}\n",
	        columns * courses,
	        steps,
	        step,
	        steps * step,
	        cpuSpent,
	        wallSpent);
}
