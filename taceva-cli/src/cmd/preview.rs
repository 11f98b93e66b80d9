//! `taceva preview`.

use taceva_acquire::{LivePredictor, preview};
use taceva_core::Axis;
use taceva_live::Limits;

use super::Context;
use super::capture::open;
use super::device_page::OnPage;
use super::live_predictions::{LivePredictions, read_model};
use crate::args::Preview;
use crate::progress::StatusLine;
use crate::{exit, stderr};

pub(crate) fn run(args: &Preview, context: &Context) -> anyhow::Result<u8> {
    let model = args.model.as_deref();
    let model = model.map(|path| read_model(path, context)).transpose()?;
    let (spec, mut live) = open(&args.live, context)?;
    if let Some(model) = &model {
        model.check(live.frame_info())?;
    }
    let title = format!("preview of {}", spec.sensor().driver());
    let page = OnPage::open(&title, args.page.port)?;
    if let Some(most) = live.sensor_facts().force_max
        && live.measures(Axis::Fz)
    {
        page.live()
            .limits(Limits::none().with_forces(most.0, most.0));
    }
    page.live()
        .stage(&format!("{}; nothing is recorded", live.frame_info()));
    // Printed even with `--quiet`, because the page cannot be found without it.
    stderr::say(format_args!("page: {}", page.url()));
    context.say(format_args!("Ctrl-C ends the preview"));
    let shown = model
        .as_ref()
        .map(|model| LivePredictions::new(model, page.live(), context));
    if model
        .as_ref()
        .is_some_and(|model| model.asks_for_reference())
    {
        context.say(format_args!(
            "touch nothing: recording the frame without contact that the model needs"
        ));
    }
    let status = StatusLine::new(context.quiet);
    let heard = |frame: &_, prediction: &_, counts: &_| {
        if let Some(shown) = &shown {
            shown.show(frame, prediction, counts);
            status.show(&shown.line());
        }
    };
    let predictor = model
        .as_ref()
        .map(|model| LivePredictor::new(model, &heard));
    let done = preview(
        &mut live,
        &*page.viewer(),
        predictor.as_ref(),
        &context.progress,
    );
    page.live().ended(&match &done {
        Ok(()) => "the preview has ended".to_owned(),
        Err(error) => error.to_string(),
    });
    status.clear();
    if let (Some(shown), Some(predictor)) = (&shown, &predictor) {
        shown.summarise(&predictor.counts(), context);
    }
    done?;
    Ok(exit::DONE)
}
