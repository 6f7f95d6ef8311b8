//! What is said for a while, and what only screen readers are told.

use std::sync::Arc;
use std::time::Duration;

use leptos::leptos_dom::helpers::TimeoutHandle;
use leptos::prelude::*;

use super::icon::{Glyph, Icon};

/// Says things to the person, wherever the page is scrolled to.
#[derive(Clone, Copy)]
pub struct Toasts {
    shown: RwSignal<Option<Toast>>,
    told: RwSignal<String>,
    hiding: StoredValue<Option<TimeoutHandle>>,
    telling: StoredValue<Option<TimeoutHandle>>,
}

#[derive(Clone)]
struct Toast {
    text: String,
    /// What a button beside it does: its label, and the deed.
    offer: Option<(String, Act)>,
}

/// It outlasts the view that offers it.
type Act = Arc<dyn Fn() + Send + Sync>;

impl Toasts {
    pub fn new() -> Self {
        Self {
            shown: RwSignal::new(None),
            told: RwSignal::new(String::new()),
            hiding: StoredValue::new(None),
            telling: StoredValue::new(None),
        }
    }

    /// Says `text` for some seconds.
    pub fn say(&self, text: impl Into<String>) {
        self.show(Toast { text: text.into(), offer: None }, Duration::from_secs(8));
    }

    /// Says `text` with a button beside it: "Undo".
    pub fn offer(
        &self,
        text: impl Into<String>,
        label: impl Into<String>,
        act: impl Fn() + Send + Sync + 'static,
    ) {
        let offer = Some((label.into(), Arc::new(act) as Act));
        self.show(Toast { text: text.into(), offer }, Duration::from_secs(20));
    }

    /// Tells `text` to screen readers, once there is a pause.
    pub fn announce(&self, text: impl Into<String>) {
        const PAUSE: Duration = Duration::from_millis(700);
        let (text, told) = (text.into(), self.told);
        // The same text is told again only if there was something else in between.
        told.set(String::new());
        restart(self.telling, move || told.set(text.clone()), PAUSE);
    }

    pub fn dismiss(&self) {
        self.shown.set(None);
    }

    fn show(&self, toast: Toast, time: Duration) {
        let shown = self.shown;
        shown.set(Some(toast));
        restart(self.hiding, move || shown.set(None), time);
    }
}

/// What waited before is dropped, and so never done.
fn restart(waiting: StoredValue<Option<TimeoutHandle>>, act: impl Fn() + 'static, time: Duration) {
    waiting.update_value(|waiting| {
        if let Some(before) = waiting.take() {
            before.clear();
        }
        *waiting = set_timeout_with_handle(act, time).ok();
    });
}

/// Where it is said. Once in the page.
#[component]
pub fn ToastList() -> impl IntoView {
    let toasts = expect_context::<Toasts>();
    let button = move |(label, act): (String, Act)| {
        let act = move |_| {
            toasts.dismiss();
            act();
        };
        view! { <button type="button" class="button low" on:click=act>{label}</button> }
    };
    let toast = move |toast: Toast| {
        view! {
            <div class="toast">
                <span>{toast.text}</span>
                {toast.offer.map(button)}
                <button
                    type="button"
                    class="button low icon-only"
                    aria-label="Close this message"
                    on:click=move |_| toasts.dismiss()
                >
                    <Icon glyph=Glyph::Close />
                </button>
            </div>
        }
    };
    view! {
        <div class="toasts" role="status">{move || toasts.shown.get().map(toast)}</div>
        <p class="unseen" role="status">{toasts.told}</p>
    }
}
