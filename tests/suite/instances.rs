//! Instances do not know of each other: not by their numbers, not by their memory.

use client::short_or_long;
#[cfg(target_os = "linux")]
use fmi::{Fmu, Instance, InstanceOptions};
use heliotorque_tests::counting::counted;

use crate::scenarios::{Scenario, Simulation};
#[cfg(target_os = "linux")]
use crate::support::built;
use crate::support::{fresh, ok};

const INSTANCES: usize = 64;
const THREADS: usize = 8;
const STEPS: usize = 150;

/// The bytes of the state after the whole simulation: everything there is.
fn alone(scenario: Scenario) -> Vec<u8> {
    let mut simulation = Simulation::new(scenario);
    (0..STEPS).for_each(|_| simulation.step());
    simulation.bytes()
}

#[test]
fn sixty_four_instances_on_eight_threads_simulate_as_one() {
    let expected = Scenario::ALL.map(alone);
    std::thread::scope(|scope| {
        for thread in 0..THREADS {
            let expected = &expected;
            scope.spawn(move || {
                let own = |number: usize| (thread * INSTANCES / THREADS + number) % Scenario::ALL.len();
                let mut simulations: Vec<Simulation> = (0..INSTANCES / THREADS)
                    .map(|number| Simulation::new(Scenario::ALL[own(number)]))
                    .collect();
                // Turn and turn about, so that each finds the others' leavings.
                for _ in 0..STEPS {
                    simulations.iter_mut().for_each(Simulation::step);
                }
                for (number, simulation) in simulations.iter_mut().enumerate() {
                    assert!(simulation.bytes() == expected[own(number)], "{:?}", simulation.scenario);
                }
            });
        }
    });
}

/// The seam between two threads: made on one, simulated on another, freed on a third.
#[test]
fn an_instance_may_change_threads() {
    let expected = alone(Scenario::Commanded);
    let simulation = std::thread::spawn(|| Simulation::new(Scenario::Commanded)).join().unwrap();
    let found = std::thread::spawn(move || {
        let mut simulation = simulation;
        (0..STEPS).for_each(|_| simulation.step());
        let bytes = simulation.bytes();
        (simulation, bytes)
    });
    let (simulation, bytes) = found.join().unwrap();
    assert!(bytes == expected);
    std::thread::spawn(move || drop(simulation)).join().unwrap();
}

fn cycle(model: &str) {
    let mut instance = fresh(model);
    ok(instance.start(0.0, None));
    ok(instance.do_step(0.0, 60.0));
}

#[test]
fn freeing_an_instance_gives_back_every_byte() {
    for model in ["Empty", "AllTypes", "MomentumPlant", "SpinPlant", "DisturbanceTorque", "Guidance"] {
        cycle(model);
        let ((), count) = counted(|| (0..short_or_long(50, 200)).for_each(|_| cycle(model)));
        assert_eq!(count.live_bytes, 0, "{model}");
    }
    for scenario in Scenario::ALL {
        let ((), count) = counted(|| {
            let mut simulation = Simulation::new(scenario);
            (0..20).for_each(|_| simulation.step());
            let _ = simulation.bytes();
        });
        assert_eq!(count.live_bytes, 0, "{scenario:?}");
    }
}

#[cfg(target_os = "linux")]
const CHILD: &str = "HELIOTORQUE_TEST_MEMORY";
/// As many as take some seconds: a shipped model reads its spacecraft and describes itself every time, and the models
/// before it in the library are compared first.
#[cfg(target_os = "linux")]
const CYCLES: [(&str, usize); 5] = [
    ("Empty", 100_000),
    ("MomentumPlant", 10_000),
    ("SpinPlant", 4_000),
    ("DisturbanceTorque", 4_000),
    ("Guidance", 4_000),
];
/// The smallest blocks leaked in each of 4,000 cycles would be 96,000 bytes.
#[cfg(target_os = "linux")]
const SLACK_BYTES: usize = 4096;
/// The smallest mappings leaked in each of 4,000 cycles would be 16,000 kB; the heap itself may grow once by what no
/// hole of it takes.
#[cfg(target_os = "linux")]
const SLACK_KB: u64 = 1024;

/// Returns the memory in use from the allocator of this process, which the libraries share.
#[cfg(target_os = "linux")]
#[expect(unsafe_code, reason = "glibc's count of its blocks has no safe form")]
fn allocated_bytes() -> usize {
    // SAFETY: reads the allocator's counts under its own locks and touches no memory of ours.
    let counts = unsafe { libc::mallinfo2() };
    counts.uordblks + counts.hblkhd
}

/// Returns the memory of this process without mapped files, in kB, counted page by page: the figures of `/proc/self/status` are off
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
    let scratch = tempfile::tempdir().unwrap();
    for (model, cycles) in CYCLES {
        let cycles = short_or_long(cycles / 10, cycles);
        let fmu = match model {
            "Empty" => crate::shared_library::folder(scratch.path(), model, &probe),
            _ => Fmu::open(dist.join(format!("{model}.fmu"))).unwrap(),
        };
        let many = |cycles| {
            (0..cycles).for_each(|_| drop(Instance::new(&fmu, "one", &InstanceOptions::default()).unwrap()));
        };
        many(cycles / 20);
        let (bytes_before, kb_before) = (allocated_bytes(), anonymous_kb());
        many(cycles);
        let (bytes, kb) = (allocated_bytes(), anonymous_kb());
        eprintln!("{model}: {cycles} cycles, {bytes_before} -> {bytes} bytes in {kb_before} -> {kb} kB");
        assert!(bytes <= bytes_before + SLACK_BYTES, "{model}: {bytes_before} -> {bytes} bytes");
        assert!(kb <= kb_before + SLACK_KB, "{model}: {kb_before} -> {kb} kB");
    }
}
