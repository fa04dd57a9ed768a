//! Instances do not know of each other: not by their numbers, not by their memory.

use heliotorque_tests::counting::counted;
#[cfg(target_os = "linux")]
use loader::{Fmu, InstanceOptions};

use crate::flights::{Flight, Style};
#[cfg(target_os = "linux")]
use crate::support::built;
use crate::support::{fresh, ok};

const INSTANCES: usize = 64;
const THREADS: usize = 8;
const STEPS: usize = 150;

/// The bytes of the state after the whole flight: everything there is.
fn alone(style: Style) -> Vec<u8> {
    let mut flight = Flight::new(style);
    (0..STEPS).for_each(|_| flight.step());
    flight.bytes()
}

#[test]
fn sixty_four_instances_on_eight_threads_fly_as_one() {
    let wanted = Style::ALL.map(alone);
    std::thread::scope(|scope| {
        for _ in 0..THREADS {
            scope.spawn(|| {
                let mut flights: Vec<Flight> = (0..INSTANCES / THREADS)
                    .map(|number| Flight::new(Style::ALL[number % Style::ALL.len()]))
                    .collect();
                // Turn and turn about, so that each finds the others' leavings.
                for _ in 0..STEPS {
                    flights.iter_mut().for_each(Flight::step);
                }
                for (number, flight) in flights.iter_mut().enumerate() {
                    assert!(flight.bytes() == wanted[number % Style::ALL.len()], "{:?}", flight.style);
                }
            });
        }
    });
}

/// The seam between two threads: made on one, flown on another, freed on a third.
#[test]
fn an_instance_may_change_threads() {
    let wanted = alone(Style::Commanded);
    let flight = std::thread::spawn(|| Flight::new(Style::Commanded)).join().unwrap();
    let found = std::thread::spawn(move || {
        let mut flight = flight;
        (0..STEPS).for_each(|_| flight.step());
        let bytes = flight.bytes();
        (flight, bytes)
    });
    let (flight, bytes) = found.join().unwrap();
    assert!(bytes == wanted);
    std::thread::spawn(move || drop(flight)).join().unwrap();
}

fn cycle(model: &str) {
    let mut instance = fresh(model);
    ok(instance.start(0.0, None));
    ok(instance.do_step(0.0, 60.0));
}

#[test]
fn freeing_an_instance_gives_back_every_byte() {
    for model in ["Empty", "AllTypes", "MomentumPlant", "SpinPlant", "DisturbanceTorque"] {
        cycle(model);
        let ((), count) = counted(|| (0..200).for_each(|_| cycle(model)));
        assert_eq!(count.live_bytes, 0, "{model}");
    }
    for style in Style::ALL {
        let ((), count) = counted(|| {
            let mut flight = Flight::new(style);
            (0..20).for_each(|_| flight.step());
            let _ = flight.bytes();
        });
        assert_eq!(count.live_bytes, 0, "{style:?}");
    }
}

#[cfg(target_os = "linux")]
const CHILD: &str = "HELIOTORQUE_TEST_MEMORY";
/// As many as take some seconds: a shipped model reads its spacecraft and describes itself every time, and the models
/// before it in the library are asked first.
#[cfg(target_os = "linux")]
const CYCLES: [(&str, usize); 4] =
    [("Empty", 100_000), ("MomentumPlant", 10_000), ("SpinPlant", 4_000), ("DisturbanceTorque", 4_000)];
/// The smallest blocks leaked in each of 4,000 cycles would be 125 kB, some of them in holes of the heap.
#[cfg(target_os = "linux")]
const SLACK_KB: u64 = 32;

/// What this process holds beside mapped files, in kB, counted page by page: the figures of `/proc/self/status` are off
/// by what each core has not yet added to them.
#[cfg(target_os = "linux")]
fn anonymous_kb() -> u64 {
    let text = std::fs::read_to_string("/proc/self/smaps_rollup").unwrap();
    let line = text.lines().find(|line| line.starts_with("Anonymous:")).unwrap();
    line.split_whitespace().nth(1).unwrap().parse().unwrap()
}

/// Through the shared libraries, in a process of its own: other tests would move its memory.
#[test]
#[cfg(target_os = "linux")]
fn memory_stays_flat_over_many_instances() {
    let (Some(probe), Some(dist)) = (built("HELIOTORQUE_PROBE_LIBRARY"), built("HELIOTORQUE_DIST")) else {
        return;
    };
    if std::env::var_os(CHILD).is_none() {
        let name = "instances::memory_stays_flat_over_many_instances";
        eprint!("{}", crate::support::in_a_process_of_its_own(name, CHILD, "1".as_ref()));
        return;
    }
    let room = tempfile::tempdir().unwrap();
    for (model, cycles) in CYCLES {
        let fmu = match model {
            "Empty" => crate::shared_library::folder(room.path(), model, &probe),
            _ => Fmu::open(dist.join(format!("{model}.fmu"))).unwrap(),
        };
        let many = |cycles| {
            (0..cycles).for_each(|_| drop(fmu.instantiate("one", &InstanceOptions::default()).unwrap()));
        };
        many(cycles / 20);
        let before = anonymous_kb();
        many(cycles);
        let after = anonymous_kb();
        eprintln!("{model}: {cycles} cycles, {before} kB -> {after} kB");
        assert!(after <= before + SLACK_KB, "{model}: {before} kB -> {after} kB");
    }
}
