//! `taceva preview`.

use taceva_acquire::preview;
use taceva_core::Axis;
use taceva_live::Limits;

use super::Context;
use super::capture::open;
use super::on_page::OnPage;
use crate::args::Preview;
use crate::{exit, stderr};

pub(crate) fn run(args: &Preview, context: &Context) -> anyhow::Result<u8> {
    let (spec, mut live) = open(&args.live, context)?;
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
    // Even if nothing else is to be said: without it nobody finds the page.
    stderr::say(format_args!("page: {}", page.url()));
    context.say(format_args!("Ctrl-C ends it"));
    let done = preview(&mut live, &*page.viewer(), &context.progress);
    page.live().ended(&match &done {
        Ok(()) => "the preview has ended".to_owned(),
        Err(error) => error.to_string(),
    });
    done?;
    Ok(exit::DONE)
}
