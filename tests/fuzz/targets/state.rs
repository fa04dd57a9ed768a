//! Any bytes under a right seal are refused or usable: the first byte picks the model, the others are the payload.
#![no_main]

use fmi_export::model_description::Status;
use heliotorque_fuzz::Subject;
use libfuzzer_sys::{Corpus, fuzz_target};

fuzz_target!(|input: &[u8]| -> Corpus {
    let Some((choice, payload)) = input.split_first() else { return Corpus::Reject };
    Subject::with(*choice, |subject| {
        let sealed = subject.seal(payload);
        let (status, state) = subject.instance.deserialize(&sealed);
        subject.check_messages(status);
        if status != Status::Ok {
            return Corpus::Keep;
        }
        // Read and written again, what was accepted is accepted again.
        assert_eq!(subject.instance.set_state(&state), Status::Ok);
        let (status, bytes) = subject.instance.state_bytes();
        assert_eq!(status, Status::Ok);
        assert_eq!(subject.instance.deserialize(&bytes).0, Status::Ok);
        let _ = subject.instance.take_messages();
        for _ in 0..3 {
            // In the error state what is held may be read for debugging, whatever it is.
            let (status, time_s) = subject.instance.last_successful_time();
            if status != Status::Ok {
                break;
            }
            subject.read_reals();
            let status = subject.instance.do_step(time_s, 60.0);
            subject.check_messages(status);
            if status != Status::Ok {
                break;
            }
        }
        Corpus::Keep
    })
});
