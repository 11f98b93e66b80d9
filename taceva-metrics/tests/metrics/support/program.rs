//! Interprets bytes as a program that adds batches, merges, and writes, damages and reads states.
//!
//! A test on any compiler and the fuzzer share this code. No program may panic. The result is an error, or scores that do not depend
//! on the order of operations.

use taceva_core::{Batch, Channel, Channels, Column, FieldSet, Labels};
use taceva_metrics::{Evaluator, MetricPlan, State, catalogue};

/// Reads bytes in order, then zeros.
struct Tape<'a> {
    bytes: &'a [u8],
}

impl Tape<'_> {
    fn byte(&mut self) -> u8 {
        match self.bytes.split_first() {
            Some((&first, rest)) => {
                self.bytes = rest;
                first
            }
            None => 0,
        }
    }

    /// Any binary64. Typical magnitudes and special values are more frequent than in random bit patterns.
    fn number(&mut self) -> f64 {
        let everyday = |byte: u8| f64::from(byte) / 16.0 - 8.0;
        match self.byte() % 8 {
            0 => f64::from_bits(u64::from_le_bytes(std::array::from_fn(|_| self.byte()))),
            1 => f64::from_bits(u64::from(self.byte())),
            2 => everyday(self.byte()) * 2.0_f64.powi(8 * i32::from(self.byte()) - 1024),
            3 => {
                [0.0, -0.0, f64::NAN, f64::INFINITY, f64::MAX, 1e308][usize::from(self.byte() % 6)]
            }
            _ => everyday(self.byte()),
        }
    }

    fn batch(&mut self, channels: &Channels) -> Batch {
        let rows = self.byte() % 40;
        let mut columns = || {
            let column = |_| {
                let mut column = Column::default();
                for _ in 0..rows {
                    let absent = self.byte().is_multiple_of(16);
                    column.push((!absent).then(|| self.number()));
                }
                column
            };
            (0..channels.len()).map(column).collect::<Vec<_>>()
        };
        let (truth, prediction) = (columns(), columns());
        let points = (!self.byte().is_multiple_of(8)).then(|| {
            let locations = 1 + self.byte() % 100;
            let mut points = Labels::default();
            for _ in 0..rows {
                points.push(&format!("p{}", self.byte() % locations));
            }
            points
        });
        Batch::from_columns(channels.clone(), truth, prediction, points)
    }
}

/// Runs the program in `bytes`. Returns the numbers of batches, of merges and of states read back.
pub(crate) fn run(bytes: &[u8]) -> [usize; 3] {
    let mut tape = Tape { bytes };
    let channels = Channels::new([Channel::FX, Channel::FY]).expect("two channels");
    let plan = MetricPlan::new(&catalogue::ALL, channels.clone(), FieldSet::PAIRS);
    let mut evaluators = vec![Evaluator::new(&plan), Evaluator::new(&plan)];
    let mut done = [0; 3];
    while !tape.bytes.is_empty() {
        let which = usize::from(tape.byte() % 2);
        match tape.byte() % 4 {
            0 | 1 => {
                let batch = tape.batch(&channels);
                evaluators[which]
                    .update(&batch)
                    .expect("the plan's channels");
                done[0] += 1;
            }
            2 => {
                let other = std::mem::replace(&mut evaluators[1 - which], Evaluator::new(&plan));
                evaluators[which].merge(other).expect("one plan");
                done[1] += 1;
            }
            _ => done[2] += read_back(&mut tape, &mut evaluators[which]),
        }
    }
    for evaluator in evaluators {
        let evaluation = evaluator.finish().expect("the plan's channels");
        for (metric, channel, score) in evaluation.scores() {
            let value = score.value.scalar();
            assert!(
                value.is_none_or(f64::is_finite),
                "{} {channel}: {value:?}",
                metric.id
            );
        }
    }
    done
}

/// Writes the states, sometimes damages the text, and merges the states that can still be read.
fn read_back(tape: &mut Tape<'_>, evaluator: &mut Evaluator) -> usize {
    let states = evaluator.states().expect("nothing is left to collect");
    let mut read = 0;
    for state in &states {
        let mut text = serde_json::to_string(state)
            .expect("states are JSON")
            .into_bytes();
        for _ in 0..tape.byte() % 4 {
            let place = usize::from(tape.byte()) << 8 | usize::from(tape.byte());
            let place = place % text.len();
            text[place] = b"0123456789-+[]\",e "[usize::from(tape.byte() % 18)];
        }
        if let Ok(damaged) = serde_json::from_slice::<State>(&text) {
            read += 1;
            // An error is as good as a merge: both leave a usable evaluator.
            let _outcome = evaluator.merge_states(&[damaged]);
        }
    }
    read
}
