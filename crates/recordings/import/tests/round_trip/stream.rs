//! Tests of samples and frames of a dataset that are passed to a sink.

use std::fs;

use taceva_core::{Field, FieldSet, Sample, SampleSink, SilentProgress, SinkError};
use taceva_dataset::{ChannelOrder, Dataset, Pass};

use super::jobs;
use crate::lab::{Lab, rgb_png};

struct Keep {
    fields: FieldSet,
    samples: Vec<Sample>,
}

impl SampleSink for Keep {
    fn fields(&self) -> FieldSet {
        self.fields
    }
    fn accept(&mut self, sample: &Sample) -> Result<(), SinkError> {
        self.samples.push(sample.clone());
        Ok(())
    }
}

#[test]
fn a_stream_gives_the_same_samples_on_any_number_of_threads() {
    let lab = Lab::new();
    lab.import().expect("imported");
    let dataset = Dataset::open(&lab.path("set")).expect("opens");
    let stream = |count, fields| {
        let mut sink = Keep {
            fields,
            samples: Vec::new(),
        };
        let pass = Pass::new(&[4, 0, 2], jobs(count), &SilentProgress);
        let report = dataset.stream(pass, &mut sink).expect("streamed");
        (report.frames_decoded, sink.samples)
    };
    let with_frames = FieldSet::PAIRS.with(Field::Frame);
    let (decoded, samples) = stream(1, with_frames);
    assert_eq!(decoded, 3);
    assert_eq!(samples[0].id, "press 4");
    assert!(samples.iter().all(|sample| sample.frame.is_some()));
    assert_eq!(stream(2, with_frames), (3, samples));
}

#[test]
fn no_frame_is_decoded_for_a_sink_that_reads_none() {
    let lab = Lab::new();
    lab.import().expect("imported");
    fs::remove_dir_all(lab.path("set/frames")).expect("removed");
    let dataset = Dataset::open(&lab.path("set")).expect("opens");
    let rows = dataset.all_rows();
    let pass = Pass::new(&rows, jobs(2), &SilentProgress);
    let mut sink = Keep {
        fields: FieldSet::PAIRS,
        samples: Vec::new(),
    };
    let report = dataset.stream(pass, &mut sink).expect("streamed");
    assert_eq!((report.samples, report.frames_decoded), (5, 0));
}

#[test]
fn frames_of_blue_green_red_files_come_out_red_green_blue() {
    let lab = Lab::new();
    lab.replace("map.toml", "\"gray\"", "\"bgr\"");
    for row in 0..5 {
        lab.write(&format!("source/images/{row}.png"), &rgb_png(8, 6, row));
    }
    lab.import().expect("imported");
    let dataset = Dataset::open(&lab.path("set")).expect("opens");
    let frames = dataset.header().frames.as_ref().expect("frames");
    assert_eq!(frames.channel_order, ChannelOrder::Bgr);
    let frame = dataset.frame(2).expect("decodes").expect("there");
    let file = image::load_from_memory(&rgb_png(8, 6, 2))
        .expect("decodes")
        .into_bytes();
    assert_eq!(frame.bytes()[..3], [file[2], file[1], file[0]]);
}
