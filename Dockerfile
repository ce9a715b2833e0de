# The README's two commands on a bare Debian 12.
#   docker build -t hysteron .
#   docker run --rm -v "$PWD/out:/hysteron/out" hysteron                 # drape cotton broad: pictures in out/drape
#   docker run --rm -v "$PWD/out:/hysteron/out" hysteron swing --quick
#   docker run --rm --entrypoint tests/run.sh hysteron                   # every test
# It is for CPUs as the one that builds it: HYSTERON_ARCH is native.
FROM debian:bookworm-slim
WORKDIR /hysteron
COPY . .
RUN experiments/run.sh list laws && rm -rf /var/lib/apt/lists/*
ENTRYPOINT ["experiments/run.sh"]
