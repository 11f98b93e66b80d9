//! A force transducer with drift, cross-talk and noise.

use crate::parameters::Transducer;
use crate::random::{Purpose, Random, Stream};

/// Errors of the transducer of one run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TransducerModel {
    transducer: Transducer,
    cross_talk: [[f64; 3]; 3],
    random: Random,
}

impl TransducerModel {
    pub(crate) fn new(transducer: Transducer, random: Random) -> TransducerModel {
        let stream = random.stream(Purpose::CrossTalk, 0);
        let cross_talk = std::array::from_fn(|row| {
            std::array::from_fn(|column| {
                if row == column {
                    return 1.0;
                }
                let index = 3 * row as u64 + column as u64;
                stream.between(index, -transducer.cross_talk, transducer.cross_talk)
            })
        });
        TransducerModel {
            transducer,
            cross_talk,
            random,
        }
    }

    /// Zero offset of the transducer at a point, N.
    pub(crate) fn point_zero_n(&self, point: u64) -> [f64; 3] {
        let stream = self.random.stream(Purpose::ZeroDrift, point);
        normals(stream, 0, self.transducer.point_drift_n)
    }

    /// Additional zero offset at a press, N.
    pub(crate) fn press_zero_n(&self, press: u64) -> [f64; 3] {
        let stream = self.random.stream(Purpose::PressDrift, press);
        normals(stream, 0, self.transducer.press_drift_n)
    }

    /// Reading of `force_n` with the zero `zero_n`. `noise` and `reading` select its noise.
    pub(crate) fn read(
        &self,
        force_n: [f64; 3],
        zero_n: [f64; 3],
        noise: Stream,
        reading: u64,
    ) -> [f64; 3] {
        let noise = normals(noise, 3 * reading, self.transducer.noise_n);
        std::array::from_fn(|row| {
            let mixing = self.cross_talk[row];
            let mixed: f64 = mixing
                .iter()
                .zip(force_n)
                .map(|(mix, force)| mix * force)
                .sum();
            mixed + zero_n[row] + noise[row]
        })
    }

    /// Noise of the normal component only, for a search.
    pub(crate) fn normal_noise_n(&self, noise: Stream, reading: u64) -> f64 {
        self.transducer.noise_n * noise.normal(reading)
    }
}

fn normals(stream: Stream, first: u64, deviation: f64) -> [f64; 3] {
    [0, 1, 2].map(|axis| deviation * stream.normal(first + axis))
}
