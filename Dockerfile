# The tool with its page:
#   docker build -t lambent . && docker run --rm -v "$PWD:/work" lambent info model.glb
# Pictures are drawn by OpenGL on the CPU (Mesa); --backend cpu takes none.
FROM debian:12 AS build
ENV DEBIAN_FRONTEND=noninteractive
RUN apt-get update && apt-get install -y --no-install-recommends ca-certificates git make
COPY . /source
WORKDIR /source
RUN make install PREFIX=/opt/lambent

FROM debian:12-slim
COPY packaging/runtime-packages.txt /tmp/
RUN apt-get update \
 && grep -v '^#' /tmp/runtime-packages.txt \
  | xargs apt-get install -y --no-install-recommends \
 && rm -rf /var/lib/apt/lists/* /tmp/runtime-packages.txt
COPY --from=build /opt/lambent/bin /opt/lambent/bin
COPY --from=build /opt/lambent/share /opt/lambent/share
ENV PATH=/opt/lambent/bin:$PATH
WORKDIR /work
ENTRYPOINT ["lambent"]
