//! DisturbanceTorque: three spacecraft, every option.

use models::DisturbanceTorque;

use super::bench::Bench;
use super::random::RandomNumbers;
use super::spacecraft::{ALL, RADIATING};

const KINDS: [&str; 2] = ["planetLight.method", "eclipse.method"];

fn measure(text: &str, map: bool, shapes: bool) {
    let mut bench = Bench::<DisturbanceTorque>::new(text);
    let mut random = RandomNumbers(5);
    for round in 0..200 {
        let mut values = bench.defaults();
        let sun = random.direction();
        let altitude = 1.05 + 2.0 * random.next();
        let aside = random.direction();
        // Toward the penumbra in one of three: the planet before the Sun, off by its angular radius.
        let planet = if round % 3 == 0 {
            let along: f64 = (0..3).map(|i| sun[i] * aside[i]).sum();
            let across = [0, 1, 2].map(|i| aside[i] - along * sun[i]);
            let length = across.iter().map(|x| x * x).sum::<f64>().sqrt();
            let edge = (1.0 / altitude).asin() + 2e-3 * (random.next() - 0.5);
            [0, 1, 2].map(|i| edge.cos() * sun[i] + edge.sin() * across[i] / length)
        } else {
            random.direction()
        };
        // Now and then not set yet.
        let distance_m = if round % 10 == 7 { 0.0 } else { 5.8e10 };
        bench.put_vector(&mut values, "sun.positionBody", &sun.map(|x| distance_m * x));
        bench.put_vector(&mut values, "planet.positionBody", &planet.map(|x| altitude * 2.4394e6 * x));
        bench.put_vector(&mut values, "planet.pole", &random.direction());
        bench.put_vector(&mut values, "spacecraft.centerOfMass", &random.direction().map(|x| 0.3 * x));
        bench.put(&mut values, "planetLight.belts", 8.0);
        bench.put(&mut values, "planetLight.nodes", random.whole(3, 6));
        bench.put(&mut values, KINDS[0], random.whole(1, if map { 3 } else { 2 }));
        bench.put(&mut values, KINDS[1], random.whole(1, 4));
        bench.put(&mut values, "planet.dayTemperature", random.whole(1, 2));
        if bench.outlined {
            bench.put(&mut values, "shadowing.enabled", random.whole(0, 1));
        }
        for effect in ["planetLight", "thermal", "gravityGradient"] {
            let acts = random.whole(0, 3).min(1.0);
            bench.put(&mut values, &format!("{effect}.enabled"), acts);
        }
        bench.put(&mut values, "shadowing.sunDisc", random.whole(0, 1));
        bench.put(&mut values, "planet.present", if round == 5 { 0.0 } else { 1.0 });
        if shapes {
            bench.put(&mut values, "sunshade.shape", random.whole(1, 2));
        }
        for k in 1..9 {
            if bench.has(&format!("panel[{k}].angle")) {
                bench.put(&mut values, &format!("panel[{k}].angle"), random.between(-3.0, 3.0));
            }
        }
        bench.look_at_start(&values, 0.0);
        let mut flight = bench.initialize(&values, 0.0).unwrap();
        bench.step(&mut flight, 10.0).unwrap();
        bench.look_at_step(&flight);
        if round > 40 && bench.is_done() {
            break;
        }
    }
    bench.judge();
}

#[test]
fn disturbance_torque_shipped() {
    measure(<DisturbanceTorque as fmi_export::Model>::DEFAULT_SETUP, false, false);
}

#[test]
fn disturbance_torque_per_plate() {
    measure(RADIATING, false, false);
}

#[test]
fn disturbance_torque_with_everything() {
    measure(ALL, true, true);
}
