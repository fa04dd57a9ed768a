//! Temperatures at which a surface gives off what it takes in.

use crate::constants::STEFAN_BOLTZMANN_W_M2_K4;
use crate::numerics::scalar::Scalar;
use crate::spacecraft::{BusLink, Conduction, Emission};

/// Newton's method stops when it changes no temperature by more than this part.
const TOLERANCE: f64 = 1e-13;

/// From an isothermal start ten iterations are many; damping needs more only for extreme materials.
const MOST_ITERATIONS: usize = 100;

/// Power per area a face radiates at a temperature, in W/m2, and its derivative by temperature.
#[inline]
pub fn exitance_w_m2<T: Scalar>(emission: &Emission<T>, temperature_k: T) -> (T, T) {
    let (emissivity, slope) = emission.at(temperature_k);
    let cube = temperature_k * temperature_k * temperature_k * STEFAN_BOLTZMANN_W_M2_K4;
    let fourth = cube * temperature_k;
    (emissivity * fourth, emissivity * cube * 4.0 + slope * fourth)
}

/// Surroundings that a face gives off heat to: space in front, and the bus behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceEnvironment<T = f64> {
    /// Emission of the face.
    pub emission: Emission<T>,
    /// Temperature of the space it sees, in K.
    pub background_k: f64,
    /// Heat flow to the bus.
    pub bus: BusLink,
}

impl<T: Scalar> FaceEnvironment<T> {
    /// Power per area that the face radiates more than it takes in from space, in W/m2, and its derivative by temperature.
    #[inline]
    pub fn radiated_w_m2(&self, temperature_k: T) -> (T, T) {
        let (exitance, exitance_slope) = exitance_w_m2(&self.emission, temperature_k);
        let (emissivity, slope) = self.emission.at(temperature_k);
        let from_space = STEFAN_BOLTZMANN_W_M2_K4 * fourth(self.background_k);
        (exitance - emissivity * from_space, exitance_slope - slope * from_space)
    }

    /// The same with what flows to the bus.
    #[inline]
    pub fn outflow_w_m2(&self, temperature_k: T) -> (T, T) {
        let (radiated, slope) = self.radiated_w_m2(temperature_k);
        let conductance_w_m2_k = self.bus.conductance_w_m2_k;
        let to_bus = (temperature_k - self.bus.temperature_k) * conductance_w_m2_k;
        (radiated + to_bus, slope + T::constant(conductance_w_m2_k))
    }

    /// The same of another number type.
    pub fn map<U>(self, of: impl Fn(T) -> U) -> FaceEnvironment<U> {
        let Self { emission, background_k, bus } = self;
        FaceEnvironment { emission: emission.map(of), background_k, bus }
    }

    /// The bus's temperature, where heat flows to it.
    fn bus_k(&self) -> f64 {
        if self.bus.conducts() { self.bus.temperature_k } else { 0.0 }
    }
}

fn fourth(temperature_k: f64) -> f64 {
    (temperature_k * temperature_k) * (temperature_k * temperature_k)
}

/// Temperature of a face that takes in `heat_w_m2` and radiates to its environment alone (eq 43 where they are cold). No
/// heat gives the temperature of space.
pub fn face_temperature_k<T: Scalar>(face: &FaceEnvironment<T>, heat_w_m2: T) -> T {
    let (seeded, heat) = (face, heat_w_m2.value());
    let face = &face.map(T::value);
    let emission = &face.emission;
    if heat <= 0.0 && !face.bus.conducts() {
        return T::constant(face.background_k);
    }
    let alone = heat / (emission.emissivity * STEFAN_BOLTZMANN_W_M2_K4) + fourth(face.background_k);
    let mut temperature_k = alone.sqrt().sqrt().max(face.bus_k());
    if temperature_k <= 0.0 {
        return T::constant(0.0);
    }
    if emission.slope_per_k != 0.0 || face.bus.conducts() {
        for _ in 0..MOST_ITERATIONS {
            let (outflow, slope) = face.outflow_w_m2(temperature_k);
            let change = damped((heat - outflow) / slope, temperature_k);
            temperature_k += change;
            if change.abs() <= TOLERANCE * temperature_k {
                break;
            }
        }
    }
    // One more step in the kernel's numbers carries the derivative over exactly.
    let (outflow, slope) = seeded.outflow_w_m2(T::constant(temperature_k));
    (heat_w_m2 - outflow) / slope.value() + temperature_k
}

/// Temperatures of front and rear of a thin structure that take in `heat_w_m2` each (eqs 44-49).
///
/// Newton's method on the two energy balances, from the temperature both faces had in common; the balances close to
/// 1e-12 of the heat. Without heat both faces have the temperature of space, which must be the same for both. Heat must not be negative;
/// radiative exchange or conductance may be 0, not both.
pub fn conducting_temperatures_k<T: Scalar>(
    faces: &[FaceEnvironment<T>; 2],
    conduction: &Conduction,
    heat_w_m2: [T; 2],
) -> [T; 2] {
    let (seeded, heat) = (faces, heat_w_m2.map(T::value));
    let faces = &faces.map(|face| face.map(T::value));
    let total = heat[0] + heat[1];
    let background_k = faces[0].background_k;
    if total <= 0.0 && !faces.iter().any(|face| face.bus.conducts()) {
        return [T::constant(background_k); 2];
    }
    let emissivity = faces[0].emission.emissivity + faces[1].emission.emissivity;
    let alone = total / (emissivity * STEFAN_BOLTZMANN_W_M2_K4) + fourth(background_k);
    let together_k = alone.sqrt().sqrt().max(faces[0].bus_k()).max(faces[1].bus_k());
    if together_k <= 0.0 {
        return [T::constant(0.0); 2];
    }
    let mut temperatures_k = [together_k; 2];
    for _ in 0..MOST_ITERATIONS {
        let balance = Balance::at(faces, conduction, temperatures_k);
        let change = balance.solve([heat[0] - balance.outflow[0], heat[1] - balance.outflow[1]]);
        let mut small = true;
        for (temperature_k, change) in temperatures_k.iter_mut().zip(change) {
            let change = damped(change, *temperature_k);
            *temperature_k += change;
            small &= change.abs() <= TOLERANCE * *temperature_k;
        }
        if small {
            break;
        }
    }
    // One more step in the kernel's numbers carries the derivative over exactly.
    let balance = Balance::at(seeded, conduction, temperatures_k);
    let change = balance.solve([0, 1].map(|i| heat_w_m2[i] - balance.outflow[i]));
    [0, 1].map(|i| change[i] + temperatures_k[i])
}

/// A change that neither halves nor doubles the temperature more than once.
fn damped(change_k: f64, temperature_k: f64) -> f64 {
    // Not `clamp`, which panics where heat without bound has made the temperature no number.
    change_k.max(-0.5 * temperature_k).min(temperature_k)
}

/// Heat flow out of each face, into space, to the bus and to the other face, with its slopes.
struct Balance<T> {
    /// In W/m2.
    outflow: [T; 2],
    /// d(flow to space and bus) / dT of each face, in W/m2/K.
    own_slope: [f64; 2],
    /// d(exchange) / dT of each face, in W/m2/K.
    exchange_slope: [f64; 2],
}

impl<T: Scalar> Balance<T> {
    #[inline]
    fn at(faces: &[FaceEnvironment<T>; 2], conduction: &Conduction, temperatures_k: [f64; 2]) -> Self {
        let [front, rear] = temperatures_k.map(T::constant);
        let (front_outflow, front_slope) = faces[0].outflow_w_m2(front);
        let (rear_outflow, rear_slope) = faces[1].outflow_w_m2(rear);
        let (exchange, exchange_slope) = exchange_w_m2(conduction, temperatures_k);
        Self {
            outflow: [front_outflow + exchange, rear_outflow - exchange],
            own_slope: [front_slope.value(), rear_slope.value()],
            exchange_slope,
        }
    }

    /// Changes of temperature that raise the outflow by `missing`.
    #[inline]
    fn solve(&self, missing: [T; 2]) -> [T; 2] {
        let [a1, a2] = self.own_slope;
        let [b1, b2] = self.exchange_slope;
        let determinant = a1 * a2 + a1 * b2 + a2 * b1;
        [
            (missing[0] * (a2 + b2) + missing[1] * b2) / determinant,
            (missing[1] * (a1 + b1) + missing[0] * b1) / determinant,
        ]
    }
}

/// Heat flow from front to rear (Q_C + Q_R of eqs 46, 47) in W/m2, and the slopes of its two terms.
#[inline]
pub fn exchange_w_m2(conduction: &Conduction, [front_k, rear_k]: [f64; 2]) -> (f64, [f64; 2]) {
    let radiative = conduction.radiative_exchange * STEFAN_BOLTZMANN_W_M2_K4;
    let [front_cube, rear_cube] = [front_k, rear_k].map(|t| radiative * t * t * t);
    let flow = front_cube * front_k - rear_cube * rear_k + conduction.conductance_w_m2_k * (front_k - rear_k);
    (flow, [front_cube, rear_cube].map(|cube| 4.0 * cube + conduction.conductance_w_m2_k))
}

#[cfg(test)]
mod tests;
