// Shows notices where a phone's browser takes them from no page. A press on one leads to the page. It keeps no file.
self.addEventListener("notificationclick", (event) => {
  event.notification.close();
  event.waitUntil(self.clients.matchAll({ type: "window" }).then(([page]) => (page ? page.focus() : self.clients.openWindow("/"))));
});
