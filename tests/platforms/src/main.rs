//! Prints the digest of every flight.

use heliotorque_platforms::FLIGHTS;

fn main() {
    for flight in FLIGHTS {
        println!("{} {:016x}", flight.name, (flight.digest)());
    }
}
