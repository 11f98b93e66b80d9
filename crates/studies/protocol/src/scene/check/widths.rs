//! Checks of the wanted widths of intervals.

use taceva_core::{Channel, shown};
use taceva_metrics::PLANES;

use super::{Check, Checked};
use crate::scene::metrics::MetricsSpec;
use crate::scene::wanted_width::WantedWidth;

impl Check<'_> {
    pub(super) fn widths(&self, metrics: &MetricsSpec) -> Checked {
        let six = Channel::SIX;
        let planes = PLANES.into_iter().map(|(plane, ..)| plane);
        let channels: Vec<&str> = six.iter().map(Channel::name).chain(planes).collect();
        for (score, width) in &metrics.want_width {
            let at = width.at();
            let Some((metric, channel)) = score.split_once('.') else {
                let problem = format!(
                    "`{}` under `want_width` names no channel: expected METRIC.CHANNEL in quotes, such as \"mae.Fz\"",
                    shown(score)
                );
                return self.contradiction(at, &problem);
            };
            if !WantedWidth::METRICS.contains(&metric) {
                let what = "metric with a wanted width";
                let known = WantedWidth::METRICS.to_vec();
                return Err(self.text.unknown_name(at, what, metric, known));
            }
            if !channels.contains(&channel) {
                let what = "channel or plane";
                return Err(self.text.unknown_name(at, what, channel, channels));
            }
            if WantedWidth::parse(score, &width.value).is_none() {
                let problem = format!(
                    "`want_width` of `{score}` is `{}`, expected a percentage above 0 % and up to 1000 %, such as \"10 %\"",
                    shown(&width.value)
                );
                return self.contradiction(at, &problem);
            }
        }
        Ok(())
    }
}
