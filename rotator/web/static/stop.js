// STOP, and nothing else: a script of its own that is loaded first, needs no other file and no new browser.
// It acts before, while and after the rest of the page does. Each try is also told to the page as the event
// "rotator-stop", so that the open WebSocket carries the STOP too. Both carry the key of the press: it counts once.
(function () {
  "use strict";

  var TRIES = 40, ANSWER_MS = 1500, AGAIN_MS = 250, SAME_PRESS_MS = 1000;
  var page = Date.now().toString(36) + Math.random().toString(36).slice(2);
  var round = 0, unheard = false, pressedMs = -SAME_PRESS_MS;

  function say(text) {
    // In the reader's language where the page is there and knows it.
    try {
      text = window.inReadersWords(text);
    } catch (fault) {
      // English then.
    }
    document.getElementById("stop-note").textContent = text;
    document.getElementById("stop-said").textContent = text;
  }

  // Only {"ok": true} of the box itself counts as heard. A proxy, a login page or an old answer is none.
  function heard(request, told) {
    return request.status === 200 && told !== null && told.ok === true;
  }

  function answered(request) {
    try {
      return JSON.parse(request.responseText);
    } catch (fault) {
      return null;
    }
  }

  function send(mine, tries) {
    if (mine !== round) return;
    var key = page + "-" + mine;
    window.dispatchEvent(new CustomEvent("rotator-stop", { detail: key }));
    var request = new XMLHttpRequest();
    request.open("POST", "/api/stop");
    request.setRequestHeader("Idempotency-Key", key);
    request.timeout = ANSWER_MS;
    request.onloadend = function () {
      if (mine !== round) return;
      var told = answered(request);
      if (heard(request, told)) {
        unheard = false;
        say("");
        return;
      }
      if (tries + 1 === TRIES) {
        say("NOT HEARD: use the box's own switch");
        return;
      }
      say(told !== null && told.error ? told.error + ": trying again" : "not heard yet: trying again");
      setTimeout(send, AGAIN_MS, mine, tries + 1);
    };
    request.send();
  }

  function press(button) {
    pressedMs = Date.now();
    button.classList.add("pressed");
    setTimeout(function () { button.classList.remove("pressed"); }, 300);
    unheard = true;
    round += 1;
    send(round, 0);
  }

  function isStop(event) {
    return event.target.closest !== undefined && event.target.closest("#stop") !== null;
  }

  function onPress(event) {
    if (!isStop(event)) return;
    // The click that ends a press is no second one. A click without a press comes from a key or a spoken command.
    if (event.type === "click" && event.detail !== 0 && Date.now() - pressedMs < SAME_PRESS_MS) return;
    event.preventDefault();
    press(document.getElementById("stop"));
  }

  // A phone's keyboard lies over the foot of the page, and fingers may spread the page: STOP stays in what is seen of it.
  function intoSight() {
    var stop = document.getElementById("stop"), seen = window.visualViewport;
    if (stop === null) return;
    stop.style.left = stop.style.right = stop.style.bottom = "0";
    var whole = stop.getBoundingClientRect();
    stop.style.left = Math.max(0, seen.offsetLeft - whole.left) + "px";
    stop.style.right = Math.max(0, whole.right - seen.offsetLeft - seen.width) + "px";
    stop.style.bottom = Math.max(0, whole.bottom - seen.offsetTop - seen.height) + "px";
  }

  if (window.visualViewport) {
    window.visualViewport.addEventListener("resize", intoSight);
    window.visualViewport.addEventListener("scroll", intoSight);
  }
  document.addEventListener("pointerdown", onPress, true);
  document.addEventListener("click", onPress, true);
  document.addEventListener("keydown", function (event) {
    var stops = event.key === "Escape" || event.key === "Esc";
    if (!stops && !(event.repeat && isStop(event))) return;
    event.preventDefault();
    if (stops && !event.repeat) press(document.getElementById("stop"));
  }, true);
  // A page that is left can wait for no answer.
  window.addEventListener("pagehide", function () {
    if (unheard && navigator.sendBeacon) navigator.sendBeacon("/api/stop");
  });
})();
