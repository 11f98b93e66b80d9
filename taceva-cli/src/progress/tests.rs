use std::io;
use std::sync::Arc;
use std::sync::atomic::AtomicUsize;

use indicatif::TermLike;

use super::*;

#[test]
fn what_is_left_follows_from_what_was_measured_and_nothing_is_said_before() {
    let minute = Duration::from_secs(60);
    assert_eq!(left(0, 10, minute), None);
    assert_eq!(left(5, 10, Duration::from_millis(10)), None);
    assert_eq!(left(5, 10, minute), Some(minute));
    assert_eq!(left(10, 10, minute), Some(Duration::ZERO));
    assert_eq!(left(1, u64::MAX, Duration::MAX), None);
    let said = [0, 89, 90, 5399, 5400].map(|seconds| spoken(Duration::from_secs(seconds)));
    assert_eq!(said, ["0 s", "89 s", "2 min", "90 min", "1 h 30 min"]);
}

/// Terminal that counts draw calls.
#[derive(Clone, Debug, Default)]
struct Drawn(Arc<AtomicUsize>);

impl Drawn {
    fn count(&self) -> usize {
        self.0.load(Ordering::SeqCst)
    }
}

impl TermLike for Drawn {
    fn width(&self) -> u16 {
        80
    }
    fn move_cursor_up(&self, _: usize) -> io::Result<()> {
        Ok(())
    }
    fn move_cursor_down(&self, _: usize) -> io::Result<()> {
        Ok(())
    }
    fn move_cursor_right(&self, _: usize) -> io::Result<()> {
        Ok(())
    }
    fn move_cursor_left(&self, _: usize) -> io::Result<()> {
        Ok(())
    }
    fn write_line(&self, line: &str) -> io::Result<()> {
        self.write_str(line)
    }
    fn write_str(&self, _: &str) -> io::Result<()> {
        self.0.fetch_add(1, Ordering::SeqCst);
        Ok(())
    }
    fn clear_line(&self) -> io::Result<()> {
        Ok(())
    }
    fn flush(&self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn no_bar_is_drawn_while_a_question_is_open() {
    let drawn = Drawn::default();
    let target = ProgressDrawTarget::term_like(Box::new(drawn.clone()));
    let bar = ProgressBar::with_draw_target(Some(10), target);
    bar.enable_steady_tick(Duration::from_millis(1));
    with_bar(|shown| *shown = Some(bar.clone()));
    let before = without_bar(|| {
        let before = drawn.count();
        std::thread::sleep(Duration::from_millis(50));
        assert_eq!(drawn.count(), before);
        before
    });
    // It is drawn again after the answer.
    assert!(drawn.count() > before);
    with_bar(|shown| *shown = None);
}

#[test]
fn a_stage_of_one_step_has_a_line_only_if_more_is_asked_for() {
    let line = |steps, is_verbose| first_line("products of features", steps, is_verbose);
    assert_eq!(line(Some(1), false), None);
    assert_eq!(
        line(Some(1), true).as_deref(),
        Some("products of features (1)")
    );
    assert_eq!(
        line(Some(2), false).as_deref(),
        Some("products of features (2)")
    );
    assert_eq!(line(None, false).as_deref(), Some("products of features"));
}

#[test]
fn plain_lines_come_every_half_minute_and_say_how_long_the_rest_takes() {
    let mut pace = Pace::new("press", Some(100));
    let begun = pace.begun;
    assert_eq!(pace.advance(10, begun + Duration::from_secs(10)), None);
    let said = pace.advance(10, begun + Duration::from_secs(40));
    assert_eq!(said.as_deref(), Some("press: 20 of 100, about 3 min left"));
    assert_eq!(pace.advance(1, begun + Duration::from_secs(41)), None);
    let mut open = Pace::new("train", None);
    let said = open.advance(3, open.begun + EVERY);
    assert_eq!(said.as_deref(), Some("train: 3"));
}
