"""A day of ten plates about the Earth in Basilisk 2.12.1: oblate gravity, air, magnetism, sunlight, gravity gradient; RK4 at 1 s.

Runs in the environment of `basilisk-requirements.txt`. By itself it writes `tests/reference/earth-basilisk.csv`:

    python tests/python/earth_basilisk.py > tests/reference/earth-basilisk.csv
"""

import tomllib

import numpy as np
from Basilisk.architecture import messaging
from Basilisk.simulation import (
    GravityGradientEffector, MtbEffector, eclipse, exponentialAtmosphere, facetDragDynamicEffector, facetSRPDynamicEffector,
    magneticFieldCenteredDipole, spacecraft, sphericalHarmonicsGravityModel, zeroWindModel,
)
from Basilisk.utilities import SimulationBaseClass, macros, simIncludeGravBody

from spacecraft import urchin

TEXT = urchin(10)
DAY_S, STEP_S, EVERY_S = 86_400.0, 1.0, 3_600.0
GM, RADIUS_M, J2, ROTATION_RAD_S = 3.986_004_355_07e14, 6_378_136.3, 1.082_635_9e-3, 7.292_115_373_194e-5
# Position, velocity, modified Rodrigues parameters and rate, all from the inertial frame, at the start.
START = [6_778_137.0, 0.0, 0.0], [0.0, 990.0, 7_604.0], [0.1, 0.2, -0.3], [1e-3, -2e-3, 1.5e-3]
SUN_M = [1.2e11, 0.8e11, 0.35e11]
DENSITY_KG_M3, HEIGHT_M, SCALE_M = 3.725e-12, 400e3, 58_515.0
DRAG_COEFFICIENT, DIPOLE_A_M2 = 2.2, [0.5, -0.3, 0.8]


class Day:
    """The simulation from a state on."""

    def __init__(self, state=START):
        body = tomllib.loads(TEXT)
        mass = body["mass_properties"]
        self.sim = SimulationBaseClass.SimBaseClass()
        self.sim.CreateNewProcess("process").addTask(self.sim.CreateNewTask("task", macros.sec2nano(STEP_S)))
        self.hub = spacecraft.Spacecraft()
        hub, center_of_mass = self.hub.hub, np.array(mass["center_of_mass_m"])
        # Its point B is the centre of mass.
        hub.mHub, hub.r_BcB_B, hub.IHubPntBc_B = mass["mass_kg"], [[0.0], [0.0], [0.0]], mass["inertia_kg_m2"]
        hub.r_CN_NInit, hub.v_CN_NInit, hub.sigma_BNInit, hub.omega_BN_BInit = state
        sun, earth = messaging.SpicePlanetStateMsgPayload(), messaging.SpicePlanetStateMsgPayload()
        sun.PositionVector, sun.PlanetName, earth.PlanetName, earth.J20002Pfix = SUN_M, "sun", "earth", np.eye(3)
        # What nothing holds is lost.
        self.kept = [messaging.SpicePlanetStateMsg().write(payload) for payload in (sun, earth)]
        self._gravity()
        self._air_and_field(body, center_of_mass)
        self._sunlight(body, center_of_mass)
        self.sim.AddModelToTask("task", self.hub)
        self.sim.InitializeSimulation()

    def _gravity(self):
        factory = simIncludeGravBody.gravBodyFactory()
        earth = factory.createEarth()
        earth.mu, earth.isCentralBody = GM, True
        gravity = sphericalHarmonicsGravityModel.SphericalHarmonicsGravityModel()
        gravity.maxDeg, gravity.radEquator, gravity.muBody = 2, RADIUS_M, GM
        gravity.cBar = [[1.0], [0.0, 0.0], [-J2 / np.sqrt(5.0), 0.0, 0.0]]
        gravity.sBar = [[0.0], [0.0, 0.0], [0.0, 0.0, 0.0]]
        earth.gravityModel = gravity
        factory.addBodiesTo(self.hub)
        self.factory = factory
        self.gradient = self._effector(GravityGradientEffector.GravityGradientEffector())
        self.gradient.addPlanetName(earth.planetName)

    def _effector(self, effector):
        self.hub.addDynamicEffector(effector)
        self.sim.AddModelToTask("task", effector)
        return effector

    def _environment(self, model):
        model.addSpacecraftToModel(self.hub.scStateOutMsg)
        self.sim.AddModelToTask("task", model)
        return model

    def _air_and_field(self, body, center_of_mass):
        self.atmosphere = exponentialAtmosphere.ExponentialAtmosphere()
        self.atmosphere.planetRadius, self.atmosphere.scaleHeight = RADIUS_M, SCALE_M
        self.atmosphere.baseDensity = DENSITY_KG_M3 * np.exp(HEIGHT_M / SCALE_M)
        self.wind = zeroWindModel.ZeroWindModel()
        self.wind.planetPosInMsg.subscribeTo(self.kept[1])
        self.wind.setPlanetOmega_N([0.0, 0.0, ROTATION_RAD_S])
        self.field = magneticFieldCenteredDipole.MagneticFieldCenteredDipole()
        self.field.g10, self.field.g11, self.field.h11, self.field.planetRadius = -29_404.8e-9, -1450.9e-9, 4652.5e-9, 6_371_200.0
        for model in (self.atmosphere, self.wind, self.field):
            self._environment(model)
        self.drag = facetDragDynamicEffector.FacetDragDynamicEffector()
        self.drag.atmoDensInMsg.subscribeTo(self.atmosphere.envOutMsgs[0])
        self.drag.windVelInMsg.subscribeTo(self.wind.envOutMsgs[0])
        for plate in body["plates"]:
            place = list(np.array(plate["center_m"]) - center_of_mass)
            self.drag.addFacet(plate["area_m2"], DRAG_COEFFICIENT, plate["normal"], place)
        self._effector(self.drag)
        bars = messaging.MTBArrayConfigMsgPayload()
        bars.numMTB, bars.GtMatrix_B, bars.maxMtbDipoles = 3, list(np.eye(3).ravel()), [10.0] * 3
        command = messaging.MTBCmdMsgPayload()
        command.mtbDipoleCmds = DIPOLE_A_M2
        self.dipole = MtbEffector.MtbEffector()
        self.kept += [messaging.MTBArrayConfigMsg().write(bars), messaging.MTBCmdMsg().write(command)]
        self.dipole.mtbParamsInMsg.subscribeTo(self.kept[2])
        self.dipole.mtbCmdInMsg.subscribeTo(self.kept[3])
        self.dipole.magInMsg.subscribeTo(self.field.envOutMsgs[0])
        self._effector(self.dipole)

    def _sunlight(self, body, center_of_mass):
        shadow = eclipse.Eclipse()
        shadow.sunInMsg.subscribeTo(self.kept[0])
        shadow.addPlanetToModel(self.kept[1])
        self._environment(shadow)
        light = facetSRPDynamicEffector.FacetSRPDynamicEffector()
        light.setNumFacets(len(body["plates"]))
        light.setNumArticulatedFacets(0)
        light.sunInMsg.subscribeTo(self.kept[0])
        light.sunEclipseInMsg.subscribeTo(shadow.eclipseOutMsgs[0])
        for plate in body["plates"]:
            optics = body["optics"][plate["optics"]]
            place = list(np.array(plate["center_m"]) - center_of_mass)
            light.addFacet(
                plate["area_m2"], np.eye(3), plate["normal"], [0.0, 0.0, 0.0], place, optics["diffuse"], optics["specular"]
            )
        self._effector(light)
        self.kept += [shadow, light]

    def run_to(self, time_s):
        self.sim.ConfigureStopTime(macros.sec2nano(time_s))
        self.sim.ExecuteSimulation()

    def state(self):
        now = self.hub.scStateOutMsg.read()
        return now.r_CN_N, now.v_CN_N, now.sigma_BN, now.omega_BN_B

    def loads(self):
        """Drag's force, and torques of drag, dipole and gravity gradient; effectors hold those of a stage inside a step otherwise."""
        self.run_to(0.0)
        for effector in (self.drag, self.dipole, self.gradient):
            effector.computeForceTorque(0.0, STEP_S)
        torques = [effector.torqueExternalPntB_B for effector in (self.drag, self.dipole, self.gradient)]
        return np.ravel([self.drag.forceExternal_B, *torques])


def table():
    """A row an hour: state by FMI names, density and field of Basilisk's, its height over a sphere, and its loads there."""
    quaternion = [f"command.q[{k}]" for k in (1, 2, 3, 4)]
    vectors = "magneticField.given", "force.aerodynamic", "torque.aerodynamic", "torque.magnetic", "torque.gravityGradient"
    elements = lambda names: [f"{name}[{k}]" for name in names for k in (1, 2, 3)]
    names = ["time", *elements(["orbit.position", "orbit.velocity"]), *quaternion, "height", "atmosphere.givenDensity"]
    yield names + elements(vectors)
    flight = Day()
    for time_s in np.arange(0.0, DAY_S + 1.0, EVERY_S):
        flight.run_to(time_s)
        position, velocity, sigma, _ = state = flight.state()
        here = Day(state)
        loads = here.loads()
        square = np.dot(sigma, sigma)
        q = [*(2.0 * np.array(sigma) / (1.0 + square)), (1.0 - square) / (1.0 + square)]
        density, field = here.atmosphere.envOutMsgs[0].read().neutralDensity, here.field.envOutMsgs[0].read().magField_N
        yield [time_s, *position, *velocity, *q, np.linalg.norm(position) - RADIUS_M, density, *field, *loads]


if __name__ == "__main__":
    for row in table():
        print(",".join(cell if isinstance(cell, str) else repr(float(cell)) for cell in row))
