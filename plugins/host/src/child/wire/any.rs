//! Decoding of arbitrary bytes as every message type, for fuzzing.

use super::{
    Answer, BenchAnswer, BenchCall, Call, Greeting, Hello, ModelAnswer, ModelCall, ModelEvent,
    ModelOrder, ModelWord, Order, OrderAnswer, Urgent, Wire, decode, encode,
};

/// Decodes `bytes` as every message type between a host and its child. Returns the number of types that succeed.
///
/// # Panics
/// If a decoded message changes when it is encoded and decoded: a bug of this crate.
pub fn read_any_message(bytes: &[u8]) -> usize {
    let read = [
        survives::<(u32, Hello)>(bytes),
        survives::<(u32, Greeting)>(bytes),
        survives::<(u32, Order)>(bytes),
        survives::<(u32, OrderAnswer)>(bytes),
        survives::<(u32, Call)>(bytes),
        survives::<(u32, Answer)>(bytes),
        survives::<(u32, Urgent)>(bytes),
        survives::<(u32, BenchCall)>(bytes),
        survives::<(u32, BenchAnswer)>(bytes),
        survives::<(u32, ModelCall)>(bytes),
        survives::<(u32, ModelAnswer)>(bytes),
        survives::<(u32, ModelOrder)>(bytes),
        survives::<ModelEvent>(bytes),
        survives::<ModelWord>(bytes),
    ];
    read.into_iter().filter(|read| *read).count()
}

fn survives<T: Wire>(bytes: &[u8]) -> bool {
    let Ok(message) = decode::<T>(bytes) else {
        return false;
    };
    // The encodings are compared, because NaN is not equal to itself. Lengths are rounded once, so the second encoding equals the first.
    let (mut once, mut twice) = (Vec::new(), Vec::new());
    if encode(&message, &mut once).is_ok() {
        let again = decode::<T>(&once).expect("encoded bytes can be decoded");
        encode(&again, &mut twice).expect("as long as before");
        assert_eq!(once, twice);
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_core::{DriverKey, DriverKind, ErrorKind, Registry, Sensor};
    use taceva_sim as _;

    fn examples() -> Vec<Vec<u8>> {
        let failure = super::super::Failure::new(ErrorKind::Timeout, "capture", "no frame");
        let descriptor = Registry::<dyn Sensor>::builtin().expect("sound");
        let descriptor = descriptor.get("sim/vitactip").expect("there").descriptor();
        let driver = DriverKey::fixed("sim/vitactip");
        let order = Order::Open {
            kind: DriverKind::Sensor,
            driver,
            args: vec![("seed".to_owned(), taceva_core::ArgValue::Whole(3))],
        };
        let mut examples = Vec::new();
        let mut add = |message: &dyn Fn(&mut Vec<u8>)| {
            let mut bytes = Vec::new();
            message(&mut bytes);
            examples.push(bytes);
        };
        add(&|bytes| (1_u32, order.clone()).write(bytes));
        add(&|bytes| {
            let described = OrderAnswer::Described {
                descriptor: descriptor.clone(),
            };
            (1_u32, described).write(bytes);
        });
        add(&|bytes| {
            let failed = Answer::Failed {
                failure: failure.clone(),
            };
            (1_u32, failed).write(bytes);
        });
        examples
    }

    #[test]
    fn no_bytes_make_a_reader_fail() {
        // Xorshift generator with a fixed seed.
        let mut state = 0x9E37_79B9_7F4A_7C15_u64;
        let mut draw = |below: usize| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            usize::try_from(state % below as u64).expect("below a length")
        };
        let examples = examples();
        let mut read = 0;
        for _ in 0..100_000 {
            let mut bytes = examples[draw(examples.len())].clone();
            for _ in 0..draw(4) {
                let at = draw(bytes.len());
                bytes[at] = u8::try_from(draw(256)).expect("a byte");
            }
            bytes.truncate(bytes.len() - draw(2) * draw(bytes.len()));
            read += read_any_message(&bytes);
        }
        assert!(
            read > 10_000,
            "only {read} were messages: nothing was tried"
        );
    }
}
