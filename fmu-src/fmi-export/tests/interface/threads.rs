//! Instances know nothing of each other: on many threads they compute the bits that one computes alone, and
//! a thousand of them made and freed leave nothing behind.

use fmi_export::model_description::Status::Ok;

use super::{PROBE, Random, described, fresh, reference};

fn simulation(seed: u64) -> Vec<u8> {
    let (mut instance, description) = fresh("AllTypes");
    let input = reference(&description, "input.real");
    let mut random = Random(seed);
    assert_eq!(instance.start(0.0, None), Ok);
    let mut time_s = 0.0;
    for _ in 0..300 {
        let step_s = 0.01 + random.below(1000) as f64 / 1000.0;
        assert_eq!(instance.set_real(&[input], &[random.below(100) as f64]), Ok);
        assert_eq!(instance.do_step(time_s, step_s), Ok);
        time_s += step_s;
    }
    instance.state_bytes().1
}

#[test]
fn sixty_four_instances_on_eight_threads_give_the_bits_of_one() {
    let alone: Vec<_> = (0..64).map(simulation).collect();
    let together: Vec<_> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..8)
            .map(|thread| scope.spawn(move || (0..8).map(|i| simulation(8 * thread + i)).collect::<Vec<_>>()))
            .collect();
        threads.into_iter().flat_map(|thread| thread.join().unwrap()).collect()
    });
    assert!(alone == together);
}

#[test]
fn an_instance_moves_between_threads() {
    let (mut instance, description) = fresh("AllTypes");
    assert_eq!(instance.start(0.0, None), Ok);
    let mut instance = std::thread::spawn(move || {
        assert_eq!(instance.do_step(0.0, 1.0), Ok);
        instance
    })
    .join()
    .unwrap();
    assert_eq!(instance.do_step(1.0, 1.0), Ok);
    assert_eq!(super::real(&mut instance, reference(&description, "role.outputApprox")), 2.0);
}

#[test]
fn what_an_instance_takes_it_gives_back() {
    let guid = described("AllTypes").guid;
    let live = || {
        let before = super::allocations::live();
        for _ in 0..300 {
            let mut instance = client::InProcess::instantiate(PROBE, &guid, None).unwrap();
            assert_eq!(instance.start(0.0, None), Ok);
            assert_eq!(instance.do_step(0.0, 1.0), Ok);
            let _ = instance.state_bytes();
            let _ = instance.get_string(&[0, 1, 2]);
        }
        super::allocations::live() - before
    };
    assert_eq!(live(), 0);
}
