//! Scores predictions of another program: adds samples one by one and prints a table.

#![expect(clippy::print_stdout, reason = "an example shows its result")]

use taceva_metrics::{Channel, Channels, FieldSet, Readings, Sample, SampleSink};
use taceva_metrics::{Evaluator, MetricPlan, catalogue};

fn main() -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
    let channels = Channels::new([Channel::PZ, Channel::FZ])?;
    let plan = MetricPlan::new(&catalogue::ALL, channels, FieldSet::PAIRS);
    let mut evaluator = Evaluator::new(&plan);
    for press in 0..40 {
        let depth_mm = 0.025 * f64::from(press);
        evaluator.accept(
            &Sample::new(format!("press {press}"))
                .with_point_id(format!("point {}", press / 4))
                .with_truth(Readings::from_values([depth_mm, 1.5 * depth_mm]))
                .with_prediction(Readings::from_values([depth_mm + 0.01, 1.4 * depth_mm])),
        )?;
    }
    println!("{}", evaluator.finish()?);
    Ok(())
}
