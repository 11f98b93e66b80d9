//! Tests of the page in a real browser: display, buttons, and a console without messages.
//!
//! Skipped, with an entry in the list of skips, if no Chromium is installed. `TACEVA_SHOTS` names a folder for screenshots.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::time::{Duration, Instant};

use serde_json::json;
use taceva_core::{
    Frame, FrameInfo, GratingKind, Millimetre, Nanometre, Newton, PixelFormat, Pose, Specimen,
    Wrench,
};
use taceva_live::{
    Limits, Live, Overlay, Page, PageOperator, Place, PlaceState, PredictedFrames, PredictedValue,
};
use taceva_needs::{Browser, Need, skip};
use taceva_protocol::{Answer, Cancel, Operator, Question};

/// A run in progress, its page, and a browser that shows it.
struct Opened {
    browser: Browser,
    live: Live,
    page: Option<Page>,
    stops: Arc<AtomicU32>,
    is_over: Arc<AtomicBool>,
    _folder: tempfile::TempDir,
}

impl Opened {
    fn new() -> Option<Opened> {
        Opened::showing(Opened::press)
    }

    fn showing(begin: impl FnOnce(&Opened)) -> Option<Opened> {
        let folder = tempfile::tempdir().expect("a folder");
        let Some(browser) = Browser::start(folder.path()) else {
            skip(Need::Browser, "no chromium on the path");
            return None;
        };
        let live = Live::new("run of a test");
        let stops = Arc::new(AtomicU32::new(0));
        let counted = Arc::clone(&stops);
        let page = Page::open(&live, 0, move || {
            counted.fetch_add(1, Ordering::SeqCst);
        });
        let is_over = Arc::new(AtomicBool::new(false));
        let mut opened = Opened {
            browser,
            live,
            page: Some(page.expect("a port")),
            stops,
            is_over,
            _folder: folder,
        };
        begin(&opened);
        opened.browser.open(&opened.url());
        Some(opened)
    }

    fn url(&self) -> String {
        self.page.as_ref().expect("open").url()
    }

    /// Sends frames and forces of a pressed gel.
    fn press(&self) {
        let live = self.live.clone();
        live.limits(Limits::none().with_forces(2.0, 1.0).with_depth(1.0));
        live.stage("press 42");
        live.lost(2, 1, true);
        let at = |number: u32| {
            let (angle, radius) = (f64::from(number) * 2.399_963, f64::from(number).sqrt());
            Place {
                x_mm: radius * angle.cos(),
                y_mm: radius * angle.sin(),
                state: match number {
                    0..=40 if number % 11 == 7 => PlaceState::Short,
                    0..=40 => PlaceState::Done,
                    41 => PlaceState::Now,
                    _ => PlaceState::Open,
                },
            }
        };
        live.places((0..120).map(at).collect());
        let is_over = Arc::clone(&self.is_over);
        std::thread::spawn(move || {
            let mut number = 0_u32;
            while !is_over.load(Ordering::Acquire) {
                let share = f64::from(number % 60) / 60.0;
                live.frame(&gel(share));
                let force = [0.1 * share, 0.3 * share, 1.8 * share].map(Newton);
                live.force(&Wrench {
                    force,
                    ..Wrench::default()
                });
                let mut pose = Pose::default();
                pose.position.z = Millimetre(0.7 * share);
                live.pose(&pose);
                number += 1;
                std::thread::sleep(Duration::from_millis(33));
            }
        });
    }

    /// Sends frames with predictions, every second one outside the training data.
    fn predict(&self) {
        let live = self.live.clone();
        live.predictor("ridge sha256:0123456789ab (presses.taceva)");
        live.predicted_frames(PredictedFrames::new(400, 4, Some(99)));
        let is_over = Arc::clone(&self.is_over);
        std::thread::spawn(move || {
            let mut number = 0_u32;
            while !is_over.load(Ordering::Acquire) {
                let values = vec![
                    PredictedValue::new("Fz", 1.25, "N"),
                    PredictedValue::new("Pz", 0.4125, "mm"),
                    PredictedValue::new("<b>µ</b>", -2.0, "1"),
                ];
                let outside = number / 10 % 2 == 1;
                let distance = if outside { 1.75 } else { 0.5 };
                let overlay = Overlay::new(f64::from(number), values);
                live.predicted(&gel(0.5), overlay.with_distance(distance, outside));
                number += 1;
                std::thread::sleep(Duration::from_millis(33));
            }
        });
    }

    /// Waits until a script returns `true`.
    fn until(&mut self, script: &str) {
        let began = Instant::now();
        while self.browser.evaluate(script) != json!(true) {
            let text = || "document.body.innerText".to_owned();
            assert!(
                began.elapsed() < Duration::from_secs(30),
                "{script}\n{}",
                self.browser.evaluate(&text())
            );
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    fn text(&mut self, id: &str) -> String {
        let value = self
            .browser
            .evaluate(&format!("document.getElementById('{id}').textContent"));
        value.as_str().unwrap_or_default().to_owned()
    }

    fn assert_quiet(&mut self) {
        let own = format!("http://{}/", self.page.as_ref().expect("open").address());
        self.browser
            .assert_quiet(|url| url.starts_with(&own) || url.starts_with("blob:"));
    }

    /// Takes a screenshot, if requested.
    fn shot(&mut self, name: &str) {
        if let Some(folder) = std::env::var_os("TACEVA_SHOTS") {
            let path = PathBuf::from(folder).join(format!("{name}.png"));
            self.browser.screenshot(&path);
        }
    }

    fn show_as(&mut self, width: u32, height: u32, scheme: &str) {
        let is_phone = width < 600;
        self.browser.call(
            "Emulation.setDeviceMetricsOverride",
            json!({"width": width, "height": height, "deviceScaleFactor": 1, "mobile": is_phone}),
        );
        let feature = json!([{"name": "prefers-color-scheme", "value": scheme}]);
        self.browser
            .call("Emulation.setEmulatedMedia", json!({"features": feature}));
    }
}

impl Drop for Opened {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Release);
    }
}

/// Frame of a gel under a ball: a gradient of three lights, and a disc that grows with `share`.
fn gel(share: f64) -> Frame {
    let info = FrameInfo {
        width: 320,
        height: 240,
        format: PixelFormat::Rgb8,
    };
    let radius = 10.0 + 50.0 * share;
    let mut pixels = Vec::with_capacity(320 * 240 * 3);
    for y in 0..240_u8 {
        for x in 0..320_u16 {
            let (dx, dy) = (f64::from(x) - 160.0, f64::from(y) - 120.0);
            let is_touched = dx.hypot(dy) < radius;
            let slope = [dx / radius, dy / radius, -dx / radius];
            for (colour, slope) in slope.into_iter().enumerate() {
                let light = 110.0 + 20.0 * [1.0, 0.0, -1.0][colour];
                let bent = if is_touched { 60.0 * slope } else { 0.0 };
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "between 0 and 255"
                )]
                pixels.push((light + bent).clamp(0.0, 255.0) as u8);
            }
        }
    }
    Frame::new(info, pixels).expect("whole")
}

const FIRST_PICTURE: &str = "document.getElementById('frame').width === 320";

#[test]
fn the_page_shows_frames_forces_and_presses_and_says_nothing_on_the_console() {
    let Some(mut opened) = Opened::new() else {
        return;
    };
    opened.until(FIRST_PICTURE);
    opened.until("document.querySelector('#normal .number').textContent.endsWith(' N')");
    assert_eq!(opened.text("title"), "run of a test");
    assert_eq!(opened.text("stage"), "press 42");
    assert_eq!(opened.text("presses"), "41 of 120");
    assert_eq!(opened.text("drops"), "3");
    opened.until("parseFloat(document.getElementById('sharpness').textContent) > 0");
    let drawn = opened
        .browser
        .evaluate("document.querySelectorAll('#map circle').length");
    assert_eq!(drawn, json!(120));
    // The page shows the sent picture: the middle of the gel is not black.
    opened.until(
        "document.getElementById('frame').getContext('2d').getImageData(10, 10, 1, 1).data[0] > 100",
    );
    opened.assert_quiet();
}

#[test]
fn a_tip_that_was_lifted_as_asked_is_beyond_no_limit_on_the_page_and_one_too_deep_is() {
    let at = |opened: &Opened, z_mm: f64| {
        let mut pose = Pose::default();
        pose.position.z = Millimetre(z_mm);
        opened.live.pose(&pose);
    };
    let begun = Opened::showing(|opened| {
        opened.live.limits(Limits::none().with_depth(1.0));
        at(opened, 1.25);
    });
    let Some(mut opened) = begun else {
        return;
    };
    // The class of the gauge is its colour.
    opened.until("document.getElementById('depth').classList.contains('over')");
    at(&opened, -20.0);
    opened.until("document.querySelector('#depth .number').textContent.startsWith('-20')");
    let classes = opened
        .browser
        .evaluate("['near', 'over'].filter((name) => document.getElementById('depth').classList.contains(name)).length");
    assert_eq!(classes, json!(0));
}

#[test]
fn nothing_leaves_the_screen_on_a_desk_or_a_phone_in_light_or_dark() {
    let Some(mut opened) = Opened::new() else {
        return;
    };
    opened.until(FIRST_PICTURE);
    let question = Question::Mount(Specimen::Grating {
        kind: GratingKind::Dot,
        spacing: Nanometre(1_500_000),
    });
    for (asked, place) in [(None, "run"), (Some(&question), "question")] {
        let _open = asked.map(|question| opened.live.ask(question));
        let is_shown = json!(asked.is_none());
        opened.until(&format!(
            "document.getElementById('question').hidden === {is_shown}"
        ));
        for (name, width, height) in [("desk", 1280, 800), ("phone", 360, 740)] {
            for scheme in ["light", "dark"] {
                opened.show_as(width, height, scheme);
                std::thread::sleep(Duration::from_millis(300));
                opened.shot(&format!("{place}-{name}-{scheme}"));
                let wide = opened
                    .browser
                    .evaluate("document.documentElement.scrollWidth <= innerWidth");
                assert_eq!(wide, json!(true), "{place} {name}");
                // The button can be reached at any scroll position.
                let reached = opened.browser.evaluate(
                    "(() => { scrollTo(0, document.body.scrollHeight); const box = document.getElementById('stop').getBoundingClientRect(); const seen = document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2); scrollTo(0, 0); return [seen && seen.id, box.height]; })()",
                );
                assert_eq!(reached[0], json!("stop"), "{place} {name}");
                assert!(
                    reached[1].as_f64().is_some_and(|high| high >= 44.0),
                    "{reached}"
                );
            }
        }
    }
    opened.assert_quiet();
}

#[test]
fn its_buttons_stop_and_answer_and_it_says_how_it_ended() {
    let Some(mut opened) = Opened::new() else {
        return;
    };
    let question = Question::Mount(Specimen::Sphere {
        radius: Nanometre(4_000_000),
    });
    let asking = opened.live.clone();
    let answer =
        std::thread::spawn(move || PageOperator::new(asking).ask(&question, &Cancel::new()));
    opened.until("!document.getElementById('question').hidden");
    assert!(opened.text("asked").contains("sphere of radius 4 mm"));
    assert_eq!(
        opened
            .browser
            .evaluate("document.querySelectorAll('#picture svg circle').length"),
        json!(1)
    );
    opened
        .browser
        .evaluate("document.getElementById('skip').click()");
    assert_eq!(answer.join().expect("no panic"), Answer::Skip);
    opened.until("document.getElementById('question').hidden");
    opened
        .browser
        .evaluate("document.getElementById('stop').click()");
    opened.until("document.getElementById('stage').textContent.startsWith('stopping')");
    assert_eq!(opened.stops.load(Ordering::SeqCst), 1);
    opened.live.ended("the run was stopped");
    opened.until("document.getElementById('stage').textContent === 'the run was stopped'");
    opened.until("document.getElementById('stop').disabled");
    opened.assert_quiet();
    // After the end of its program the page shows nothing new.
    opened.page = None;
    std::thread::sleep(Duration::from_millis(1500));
    assert_eq!(opened.text("stage"), "the run was stopped");
}

#[test]
fn without_its_token_it_says_which_address_is_needed() {
    let Some(mut opened) = Opened::new() else {
        return;
    };
    let url = opened.url();
    let (bare, _) = url.split_once('#').expect("a token");
    opened.browser.open("about:blank");
    opened.browser.open(bare);
    opened.until("!document.getElementById('lost').hidden");
    let said = opened.text("lost");
    assert!(said.contains("including the part after #"), "{said}");
    let seen = opened
        .browser
        .evaluate("document.getElementById('frame').width");
    assert_eq!(seen, json!(4));
}

#[test]
fn predictions_stand_over_the_picture_named_as_such_and_say_when_it_is_unlike_the_training() {
    let Some(mut opened) = Opened::showing(Opened::predict) else {
        return;
    };
    opened.until("!document.getElementById('predicted').hidden");
    opened.until("document.getElementById('values').innerText.includes('1.25 N')");
    let values = opened.text("values");
    for text in ["Fz1.25 N", "Pz0.412 mm", "<b>µ</b>-2.000"] {
        assert!(values.contains(text), "{values}");
    }
    opened.until("document.getElementById('by').textContent.includes('not measured')");
    assert_eq!(
        opened.text("by"),
        "predicted by ridge sha256:0123456789ab (presses.taceva), not measured"
    );
    opened.until("!document.getElementById('outside').hidden");
    opened.shot("predicted");
    opened.until("document.getElementById('outside').hidden");
    opened.until("document.getElementById('left-out').textContent === '4 of 400'");
    assert_eq!(opened.text("outside-share"), "25.0 %");
    // Gauges of readings show no prediction.
    opened.until("document.getElementById('forces').hidden");
    opened.is_over.store(true, Ordering::Release);
    opened.assert_quiet();
}
